// SPDX-License-Identifier: MIT
// The signals that stop rendering. Before the first tile there is nothing to write, so a signal
// ends the process. Afterwards the first signal requests that finished tiles are written, and the
// second ends the process at once.
#pragma once

// Installs handlers for SIGINT and SIGTERM, unless they are ignored, for the life of the process.
// Before stop_wait_for_tiles, a signal ends the process with a message and status 128 + its
// number.
void stop_watch(void);

// Call before rendering the first tile. The first signal is then only reported by stop_signal.
void stop_wait_for_tiles(void);

// Returns the signal that requested the stop, 0 if none did.
int stop_signal(void);
