// SPDX-License-Identifier: MIT
// Prepares the process for signals that stop it, for crashes of drivers, and for small stacks.
#pragma once

#include "session/session.h"

// Observes a picture's tracing: prints progress on standard error; a signal stops the tracing.
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

// Implements Cache::announce for terminals. Shows a line with the elapsed seconds, and clears it at
// the end of the last build.
void progress_show_compiling(bool begins);

// Does the same while a scene is loaded and its tree is built, unless this takes less than 0.5 s.
void progress_show_loading(bool begins);

// Implements RenderObserver::tile_done; context is a Progress. Returns false after a signal.
bool progress_tile_done(void *context, const RenderProgress *progress);

// Clears the rewritten line. Returns the signal that requested the stop, or 0.
int progress_end(Progress *progress);

// The signals that stop rendering. Before the first tile there is nothing to write, so a signal
// ends the process. Afterwards, clrt writes the finished tiles at the first signal. A second signal
// of the same number ends the process at once.

// Installs handlers for the first SIGINT and the first SIGTERM, unless these signals are ignored.
// Before stop_wait_for_tiles, a signal ends the process with a message and status 128 + its number.
void stop_watch(void);

// Call this before rendering the first tile. The first signal then only sets stop_signal's result.
void stop_wait_for_tiles(void);

// Returns the signal that requested the stop, or 0.
int stop_signal(void);

// Crashes of drivers and libraries: one message and EXIT_DEVICE instead of a signal.
//
// Installs handlers for crash signals, and for exit(), which LLVM calls on a full disk. A crash in
// clrt's own code prints a message and ends the process by its signal. After this call, main must
// end with _exit.
void crash_watch(void);

// Stacks large enough for compilers, regardless of `ulimit -s`.
//
// Calls work(context) and waits for its end. If the stack limit is below 8 MiB, work runs on a new
// thread, and threads that drivers start also get larger stacks.
void stack_run(void *(*work)(void *context), void *context);
