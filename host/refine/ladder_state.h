// SPDX-License-Identifier: MIT
// The data of a ladder (ladder.h), which ladder.c, ladder_choice.c and ladder_entry.c share.
#pragma once

#include "base/array.h"
#include "refine/ladder_strata.h"
#include "refine/refine_setup.h"
#include "render/sampler.h"

#include <math.h>

// On rung 0, a pixel has a bend (ladder_entry.c). On higher rungs, it has sums of samples.
typedef union {
    float bend;
    uint32_t sums; // index in Ladder::sums
} LadderPlace;

// The side of a block of pixels. A selection skips blocks whose masks have none of the strata from
// which it selects pixels.
#define LADDER_BLOCK 8

// The most requests per list.
#define REQUESTS_MOST (1u << 16)

typedef struct {
    RefineSetup setup;      // the picture has the means of the pixels' samples
    FrameData frame;        // with a camera made for LADDER_GRID samples
    PixelSums *answers;     // to the requests of the latest trace; room for REQUESTS_MOST
    PixelRequest *requests; // room for REQUESTS_MOST; small requests come first
    uint32_t *chosen;       // pixels; room for twice all pixels
    LadderPlace *places;    // of each pixel
    uint8_t *strata;        // of each pixel
    uint64_t *blocks; // masks of blocks: bits of all strata that have or had pixels of the block
    uint32_t listed, small; // requests in the list, and small requests in the list
    ARRAY(PixelSums) sums;  // of the pixels above rung 0
    Strata statistics;
    Strata chosen_by; // the statistics at the latest selection of pixels
    uint64_t samples; // taken so far
} Ladder;

// Returns whether the requests that advance a pixel from the rung are small. They are small until
// the pixel has LARGE_SAMPLES samples.
static inline bool ladder_is_small(uint32_t rung)
{
    return ladder_samples[rung] < LARGE_SAMPLES;
}

// Returns the bit of a stratum in a block's mask. Strata may share a bit.
static inline uint64_t ladder_stratum_bit(uint32_t stratum)
{
    return (uint64_t)1 << stratum % 64;
}

// Returns the mask of the block that contains the pixel at (x, y).
static inline uint64_t *ladder_block(const Ladder *ladder, uint32_t x, uint32_t y)
{
    const uint32_t columns = range_count(ladder->setup.picture->width, LADDER_BLOCK);
    return &ladder->blocks[(size_t)(y / LADDER_BLOCK) * columns + x / LADDER_BLOCK];
}

// The following functions use sums of a pixel's samples. Sums are integers, so they are exact in
// any order.

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

// Assigns all pixels to strata of rung 0. The picture must have the pixels' centers.
bool ladder_enter(Ladder *ladder, Error *error);

// Fills ladder->chosen with the pixels that the strata's fractions select. The pixels with small
// requests come first. Stores the number of all these pixels in *count.
bool ladder_choose(Ladder *ladder, uint64_t *count, Error *error);
