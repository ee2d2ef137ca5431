// SPDX-License-Identifier: MIT
// The first cause of a failure, as one sentence for the user. Functions that fail return false or
// NULL, and fill an Error. Programming errors assert. If a function cannot make, open or read a
// value, freeing the value is unnecessary but harmless. Headers name the exceptions.
#pragma once

#include <stdbool.h>

typedef struct {
    char text[4096]; // empty without a failure; long enough for most build logs
} Error;

// Records the failure and returns false, so that a caller can `return error_set(...)`. An error
// already recorded is kept, because the deepest cause is the most informative.
__attribute__((format(printf, 2, 3))) bool error_set(Error *error, const char *format, ...);

// error_set for a failed allocation of `bytes` bytes.
bool error_out_of_memory(Error *error, unsigned long long bytes);
