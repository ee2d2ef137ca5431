// SPDX-License-Identifier: MIT
// The first cause of a failure, as one sentence for the user.  World faults travel as a
// false return beside a filled Error; faults of our own are asserted instead.
// What makes, opens or reads a value and fails leaves nothing in it to be freed, though freeing it
// does no harm; where it must be freed all the same, the header says so.
#pragma once

#include <stdbool.h>

typedef struct {
    char text[4096]; // empty while nothing has failed; build logs fit
} Error;

// Records the failure and returns false, so that a caller can `return error_set(...)`.
// An error already recorded is kept: the deepest cause says most.
__attribute__((format(printf, 2, 3))) bool error_set(Error *error, const char *format, ...);

// error_set for an allocation of that many bytes that failed.
bool error_out_of_memory(Error *error, unsigned long long bytes);
