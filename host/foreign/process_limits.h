// SPDX-License-Identifier: MIT
// The limits of this process. They make hostile files fail early, but they are no sandbox. A file
// that takes over a library acts with the user's permissions. Only root can raise the hard limits.
#pragma once

#include <stdint.h>

// Limits processor time, elapsed time, stack and open files. Closes all files but the standard
// streams. From then on, the process gains no privileges, writes no file and dumps no core. The
// process also ends when the thread that started it ends.
void process_limits_take(void);

// Limits memory. Also forbids threads, unless the process runs as root or has CAP_SYS_ADMIN or
// CAP_SYS_RESOURCE. process_limits_allow_file raises the limit of memory for each file.
void process_limits_take_model(void);

// Adds memory and processor time for a model's file of this size, up to the hard limits.
void process_limits_allow_file(uint64_t bytes);

// Adds processor time for a picture file of this size, and limits memory to the needs of a decoder.
void process_limits_take_picture(uint64_t bytes);
