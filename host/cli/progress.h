// SPDX-License-Identifier: MIT
// Observes a picture's tracing: prints progress on standard error, and stops on the signals of
// cli/process.h.
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

// Returns whether standard error is a terminal that can rewrite lines.
bool progress_on_terminal(void);

// A Cache's announce for terminals. Shows a line with the elapsed seconds, and clears it at the end
// of the last build.
void progress_show_compiling(bool begins);

// A RenderObserver's tile_done; context must point to a Progress.
bool progress_tile_done(void *context, const RenderProgress *progress);

// Clears the rewritten line. Returns the signal that requested the stop, or 0.
int progress_end(Progress *progress);
