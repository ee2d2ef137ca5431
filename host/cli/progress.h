// SPDX-License-Identifier: MIT
// Observes a picture's tracing: prints progress on standard error, and stops on the signals of
// cli/process.h.
#pragma once

#include "render/renderer.h"

typedef struct {
    bool silent;
    bool terminal;    // standard error is a terminal: rewrite one line
    double start;     // in seconds of the clock
    unsigned printed; // percent in the last plain line
    bool line_open;   // the rewritten line is on the screen
} Progress;

Progress progress_begin(bool silent);

// The observer's function; context is a Progress.
bool progress_tile_done(void *context, const RenderProgress *progress);

// Clears the line and returns the signal that requested the stop, or 0.
int progress_end(Progress *progress);
