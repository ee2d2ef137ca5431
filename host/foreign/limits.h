// SPDX-License-Identifier: MIT
// What the process may take from the machine, whatever becomes of it.
#pragma once

#include <stddef.h>

// Gives up descriptors, privileges to come, files to write, memory and time.
void limits_take(void);

// Allows the memory that a file of so many bytes more may need, within what all may have.
void limits_allow_file(size_t bytes);
