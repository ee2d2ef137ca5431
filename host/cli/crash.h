// SPDX-License-Identifier: MIT
// Crashes of drivers and libraries: one message and EXIT_DEVICE instead of a signal.
#pragma once

// Installs handlers for crash signals, and for exit(), which LLVM calls on a full disk. A crash in
// clrt's own code prints a message and ends the process by its signal. After this call, main must
// end with _exit.
void crash_watch(void);
