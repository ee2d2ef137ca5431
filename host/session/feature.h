// SPDX-License-Identifier: MIT
// The numbers of samples in a picture's pixels -> the smallest feature (a disk) that the samples
// are likely to hit.
#pragma once

#include <stddef.h>
#include <stdint.h>

// Pixels that have equally many samples.
typedef struct {
    uint32_t samples;
    uint64_t pixels;
} SampleShare;

// Returns the smallest diameter in pixels such that a disk at a random place of the picture
// contains a sample with a probability of 95 %. The samples of a pixel count as a square lattice.
// At least one share must have pixels.
double feature_smallest(const SampleShare *shares, size_t count);
