// SPDX-License-Identifier: MIT
// Limits the resources of the process, regardless of what happens in it.
#pragma once

#include <stddef.h>

// Gives up file descriptors, later privileges, file writing, memory and time.
void limits_take(void);

// Raises the memory limit for a file of `bytes` bytes, up to the overall limit.
void limits_allow_file(size_t bytes);
