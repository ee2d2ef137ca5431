// SPDX-License-Identifier: MIT
// Observes rendering: prints progress on standard error, and stops after the signals of
// base/stop.h.
#pragma once

#include "render/renderer.h"

typedef struct {
    bool silent;
    bool terminal;    // standard error is a terminal, so one line is rewritten
    double start;     // from clock_seconds
    unsigned printed; // percent in the last line of a log
    bool line_open;   // the terminal shows the rewritten line
} Progress;

Progress progress_begin(bool silent);

// A RenderObserver's tile_done; context must point to a Progress.
bool progress_tile_done(void *context, const RenderProgress *progress);

// Clears the rewritten line. Returns the signal that requested the stop, or 0.
int progress_end(Progress *progress);
