// SPDX-License-Identifier: MIT
// Handles the signals that stop a picture.
#pragma once

// SIGINT, SIGTERM and SIGHUP stop a picture. Before the first tile, there is nothing to write, so a
// signal ends the process. Afterwards, the first signal makes clrt write the finished tiles. A
// second signal of the same number ends the process at once.

// Installs a handler for the first occurrence of each of these signals, unless the signal is
// ignored. Until stop_wait_for_tiles is called, a signal ends clrt with a message and status 128 +
// number.
void stop_watch(void);

// Call this function before the first tile is rendered. Afterwards, the first signal only sets the
// result of stop_signal.
void stop_wait_for_tiles(void);

// Returns the number of the latest signal that arrived after stop_wait_for_tiles, or 0.
int stop_signal(void);
