// SPDX-License-Identifier: MIT
// State, request and status -> the window's title, line and panel, and the text that key c prints.
#pragma once

#include "view/controls.h"
#include "view/worker.h"

#include <stdio.h>

#define STATUS_TEXT_SIZE 8192

// The data shown by the texts.
typedef struct {
    const State *state;
    const WorkerRequest *request; // the latest request, with the window's size in pixels
    const WorkerStatus *status;
    const char *scene_name;
    const char *up;     // up axis of a lone mesh file; NULL for a scene file
    uint32_t samples;   // along each side of a pixel, in anti-aliased pictures
    uint32_t box_count; // number of displayed boxes
    // The strings below are empty if there is nothing to report.
    const char *notice;      // names the pictures that were saved last
    const char *missing;     // missing objects or lights of the scene
    const char *hint;        // the key for help
    const char *failure;     // failure of the scene, the device or the window
    const char *explanation; // of the clicked pixel
} Figures;

typedef void StatusText(const Figures *figures, FILE *stream);

// Writes the state as one line without a line end, for saved pictures and -v.
StatusText status_text_state;

// Writes the line at the top: messages, state and measurements, in the order of importance.
StatusText status_text_line;

// Writes the panel: failure, explanation and help.
StatusText status_text_panel;

StatusText status_text_title;

// Stores the text that `write` writes in the `size` bytes of `text`. Longer texts are truncated.
void status_text_store(StatusText *write, const Figures *figures, char *text, size_t size);

// Writes the orbit's angles and distance, and then the camera as statements of a scene file.
void status_text_camera(const State *state, FILE *stream);
