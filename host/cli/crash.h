// SPDX-License-Identifier: MIT
// Turns crashes of drivers and libraries into one message and EXIT_DEVICE.
#pragma once

// Installs handlers for crash signals, and for exit(), which LLVM calls if the disk is full. After
// a crash in clrt's own code, the process prints a message, and the signal ends it. After this
// call, main must end with _exit.
void crash_watch(void);
