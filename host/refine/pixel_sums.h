// SPDX-License-Identifier: MIT
// Sums of a pixel's samples. They are integers, so they are exact in any order.
#pragma once

#include "scene/scene.h"

#include <math.h>

// Computes the mean color of the samples. `samples` must be a power of two.
static inline void pixel_sums_mean(const PixelSums *sums, uint32_t samples, float color[3])
{
    const double part = 1.0 / samples;
    for (int channel = 0; channel < 3; channel++) {
        const int64_t sum = (int64_t)sums->colors[channel] + samples / 2;
        color[channel] = (float)((double)(int64_t)((double)sum * part) * 0x1p-32);
    }
}

// Returns the variance of the samples' colors, averaged over the channels.
static inline double pixel_sums_variance(const PixelSums *sums, uint32_t samples)
{
    const double part = 1.0 / samples;
    double squares = (double)(int64_t)sums->squares * (0x1p-48 * part);
    for (int channel = 0; channel < 3; channel++) {
        const double mean = (double)(int64_t)sums->colors[channel] * (0x1p-32 * part);
        squares -= mean * mean;
    }
    return fmax(squares / 3, 0);
}

static inline void pixel_sums_add(PixelSums *sums, const PixelSums *more)
{
    for (int channel = 0; channel < 3; channel++)
        sums->colors[channel] += more->colors[channel];
    sums->squares += more->squares;
}
