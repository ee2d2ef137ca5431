// SPDX-License-Identifier: MIT
// Wall time for statistics; no picture depends on it.
#pragma once

#include <time.h>

// Seconds since some fixed moment, never going back.
static inline double clock_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}
