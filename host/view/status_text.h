// SPDX-License-Identifier: MIT
// State and figures -> the words of the window: its title, its overlays and what `c` prints.
#pragma once

#include "view/state.h"

#include <stdio.h>

#define STATUS_TEXT_SIZE 8192

// What is known of the picture beside the state.
typedef struct {
    const char *scene_name;
    uint32_t width, height; // of the window, in pixels
    uint32_t samples;       // per pixel and axis, where the picture is anti-aliased
    uint32_t divisor;       // the picture shown is traced with one pixel for so many a side
    bool is_finished;       // nothing more will be traced for it
    double progress;        // of the pass that is being traced, from 0 to 1
    double frame_seconds;   // of the latest frame
    bool has_counts;        // the two below are known
    uint64_t rays;
    double tests_per_ray;
    uint32_t box_count;  // of the boxes shown
    const char *busy;    // what the user waits for, empty where nothing
    const char *notice;  // what was done last, empty where nothing
    const char *failure; // why the last change has no effect, empty where it has
} Figures;

// The state alone, on one line without a line end: what tests and -v tell effects by.
void status_text_state(char *text, size_t size, const State *state, const Figures *figures);

// The overlay's line: state and figures.
void status_text_overlay(char *text, size_t size, const State *state, const Figures *figures);

void status_text_title(char *text, size_t size, const State *state, const Figures *figures);

// The camera in the course's terms, and as statements of a scene file.
void status_text_camera(char *text, size_t size, const State *state);

// The keys and the mouse, a line each.
const char *status_text_help(void);
