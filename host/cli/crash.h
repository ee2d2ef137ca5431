// SPDX-License-Identifier: MIT
// Crashes of drivers and libraries: one message and EXIT_DEVICE instead of a signal.
#pragma once

// Installs handlers for crash signals, and for exit(), which LLVM calls on a full disk.  A crash in
// clrt's own code still ends it by its signal, after a message.  From here on main must end by
// _exit.
void crash_watch(void);
