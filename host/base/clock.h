// SPDX-License-Identifier: MIT
// Wall time. A picture depends on the clock only with --time.
#pragma once

#include <time.h>

// Returns the seconds since a fixed moment. The clock never goes backward.
static inline double clock_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}
