// SPDX-License-Identifier: MIT
// The first cause of a failure, as one sentence for the user. Faults of the world return false and
// fill an Error; our own faults assert. If a function that makes, opens or reads a value fails,
// there is nothing to free, and freeing the value is harmless. Headers name the exceptions.
#pragma once

#include <stdbool.h>

typedef struct {
    char text[4096]; // empty without a failure; build logs fit
} Error;

// Records the failure and returns false, so that a caller can `return error_set(...)`. An error
// already recorded is kept, because the deepest cause is the most informative.
__attribute__((format(printf, 2, 3))) bool error_set(Error *error, const char *format, ...);

// error_set for a failed allocation of `bytes` bytes.
bool error_out_of_memory(Error *error, unsigned long long bytes);
