// SPDX-License-Identifier: MIT
// The signals that stop a picture: before its first tile there is nothing to write, so that they
// end the process; from then on the first asks for what is done to be written, and the second ends
// the process at once.
#pragma once

// Takes SIGINT and SIGTERM over where they are not ignored, for as long as the process lasts.
// Until stop_wait_for_tiles, they end it with a sentence and 128 + their number as its status.
void stop_watch(void);

// The first tile is about to be drawn: from now on the first signal is left to stop_signal.
void stop_wait_for_tiles(void);

// The signal that asked to stop, 0 where none did.
int stop_signal(void);
