// SPDX-License-Identifier: MIT
// "I/N": the I-th of N shares of a job. "auto/N" reads I from the environment variable in which
// Slurm, AWS Batch, Kubernetes or MPI stores the task's number.
#pragma once

#include "base/error.h"

#include <stdint.h>

typedef struct {
    uint32_t index, count; // index from 1 to count; 0, 0: the whole job
} Share;

// Parses text. Returns false if it is malformed or N is above most, and leaves error empty. Returns
// false and fills error if the variable is missing, not a number or out of range.
bool share_parse(Share *share, const char *text, uint32_t most, Error *error);

// Returns the index of the share's first item among `total` items. Shares are runs of consecutive
// items, and their lengths differ by at most one.
uint32_t share_begin(const Share *share, uint32_t total);
