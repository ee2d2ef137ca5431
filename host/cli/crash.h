// SPDX-License-Identifier: MIT
// Crashes of drivers and libraries: one message and EXIT_DEVICE instead of a signal.
#pragma once

// Takes over the signals of crashes, and exit(), which LLVM calls where a disk is full.  A crash in
// clrt's own code still ends it by its signal, after a message.  main ends by _exit from here on.
void crash_watch(void);
