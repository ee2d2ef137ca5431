// SPDX-License-Identifier: MIT
// Limits the threads of CPU devices through PoCL's environment variables.
#pragma once

#include <stdint.h>

// Limits PoCL's threads to count. If count is 0, the limit is the process's processors and its
// control group's quota, which PoCL ignores. The user's environment variables take precedence
// unless count is given. Only main may call it, before the first OpenCL call.
void threads_limit(uint32_t count);

// Returns the number of threads for the program itself: count or, if count is 0, the limit above.
uint32_t threads_allowed(uint32_t count);
