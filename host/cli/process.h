// SPDX-License-Identifier: MIT
// Prepares the process for signals that stop it, and for small stacks.
#pragma once

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

// Stacks large enough for compilers, regardless of `ulimit -s`.
//
// Calls work(context) and waits for its end. If the stack limit is below 8 MiB, work runs on a new
// thread, and threads that drivers start also get larger stacks.
void stack_run(void *(*work)(void *context), void *context);
