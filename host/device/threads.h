// SPDX-License-Identifier: MIT
// How many threads a CPU device may use, told to PoCL through its environment.
#pragma once

#include <stdint.h>

// Caps PoCL's threads at count, or where count is 0 at what the process may use: its processors
// and its control group's quota, which PoCL itself does not look at.  What the user set in the
// environment stays, unless count is given.  For main alone, before the first OpenCL call.
void threads_limit(uint32_t count);

// How many threads of its own the program may use: count, or where it is 0 as many as above.
uint32_t threads_allowed(uint32_t count);
