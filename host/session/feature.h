// SPDX-License-Identifier: MIT
// Samples of a picture's pixels -> the smallest feature that they find.
#pragma once

#include <stddef.h>
#include <stdint.h>

// Pixels that have equally many samples.
typedef struct {
    uint32_t samples;
    uint64_t pixels;
} SampleShare;

// Returns the smallest diameter, in pixels, for which a disk at a random place of the picture
// contains a sample with a probability of 95 %. The samples of a pixel count as a square lattice.
// At least one of the shares must have pixels.
double feature_smallest(const SampleShare *shares, size_t count);
