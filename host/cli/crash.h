// SPDX-License-Identifier: MIT
// Turns crashes of drivers and libraries into one message and EXIT_DEVICE.
#pragma once

// Installs handlers for crash signals and for exit(). LLVM calls exit() if the disk is full. After
// a crash in clrt's own code, the handler prints a message, and the signal ends the process. If
// main has called this function, main must end with _exit.
void crash_watch(void);

// From now on, the message about exit() also names the display. Xlib calls exit() if the X server
// dies.
void crash_expect_display(void);
