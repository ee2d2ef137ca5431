// SPDX-License-Identifier: MIT
// Progress of loading, compiling and tracing, on standard error.
#pragma once

#include "session/session.h"

// The context of progress_tile_done.
typedef struct {
    bool silent;
    bool terminal;    // standard error is a terminal, so one line is rewritten
    double start;     // from clock_seconds
    unsigned printed; // percentage in the last line that was printed to a log
    bool line_open;   // the terminal shows the rewritten line
} Progress;

Progress progress_begin(bool silent);

// Returns whether standard error is a terminal that can rewrite lines.
bool progress_on_terminal(void);

// Implements Cache::announce for terminals. Shows the elapsed seconds while kernels are compiled.
void progress_show_compiling(bool begins);

// Shows the elapsed seconds while a scene is loaded or its tree is built, if this takes more than
// 0.5 s.
void progress_show_loading(bool begins);

// Implements RenderObserver::tile_done for a `context` of type Progress. Prints the progress of
// tracing. Returns false after a signal, which stops tracing.
bool progress_tile_done(void *context, const RenderProgress *progress);

// Clears the rewritten line. Returns stop_signal().
int progress_end(Progress *progress);
