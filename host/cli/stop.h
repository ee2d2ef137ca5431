// SPDX-License-Identifier: MIT
// The signals that stop a picture: the first asks for what is done to be written, the second ends
// the process at once.
#pragma once

// Takes SIGINT and SIGTERM over where they are not ignored, for as long as the process lasts.
void stop_watch(void);

// The signal that asked to stop, 0 where none did.
int stop_signal(void);
