// SPDX-License-Identifier: MIT
// Watches a picture being traced: progress on standard error, and the signals that stop it, which
// base/stop.h takes.
#pragma once

#include "render/renderer.h"

typedef struct {
    bool silent;
    bool terminal;    // standard error is one: a line that rewrites itself
    double start;     // seconds of the clock
    unsigned printed; // percent in the last plain line
    bool line_open;   // a rewriting line stands unfinished
} Progress;

Progress progress_begin(bool silent);

// The observer's function; context is a Progress.
bool progress_tile_done(void *context, const RenderProgress *progress);

// Clears the line and returns the signal that asked to stop, 0 where none did.
int progress_end(Progress *progress);
