// SPDX-License-Identifier: MIT
// State and figures -> the window's title, line and panel, and the text that key c prints.
#pragma once

#include "view/controls.h"

#include <stdio.h>

#define STATUS_TEXT_SIZE 8192

// Facts about the picture that are not part of the state.
typedef struct {
    const char *scene_name;
    const char *up;         // up axis of a mesh without a scene; NULL for a scene
    uint32_t width, height; // of the window, in pixels
    uint32_t samples;       // along each side of a pixel, with anti-aliasing
    uint32_t divisor;       // one traced pixel covers divisor x divisor pixels
    bool is_finished;       // the picture is complete; counting may remain
    double progress;        // of the current pass, from 0 to 1
    double frame_seconds;   // tracing time of the latest complete picture
    bool has_counts;        // rays and tests_per_ray are known
    uint64_t rays;
    double tests_per_ray;
    uint32_t box_count; // number of displayed boxes
    // Empty strings if there is nothing to report.
    const char *busy;        // the current operation
    const char *notice;      // the latest result
    const char *missing;     // missing objects or lights of the scene
    const char *hint;        // the key for help
    const char *failure;     // failure of the scene, the device or the window
    const char *explanation; // of the clicked pixel
} Figures;

// Writes the state as one line without a line end, for saved pictures and -v.
void status_text_state(char *text, size_t size, const State *state, const Figures *figures);

// Writes the line at the top: messages, state and figures, the most important first.
void status_text_line(char *text, size_t size, const State *state, const Figures *figures);

// Writes the panel: failure, explanation and help.
void status_text_panel(char *text, size_t size, const State *state, const Figures *figures);

void status_text_title(char *text, size_t size, const State *state, const Figures *figures);

// Writes the camera in the course's terms, and as statements of a scene file.
void status_text_camera(const State *state, FILE *stream);

// Returns the list of keys and mouse actions, one per line. Two blanks precede the action's
// meaning.
const char *status_text_help(void);
