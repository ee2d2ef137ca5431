// SPDX-License-Identifier: MIT
// The data of a ladder (ladder.h), which ladder.c, ladder_choice.c and ladder_entry.c share.
#pragma once

#include "base/array.h"
#include "refine/ladder_strata.h"
#include "refine/pixel_sums.h"
#include "refine/refine_setup.h"
#include "render/sampler.h"

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

// Assigns all pixels to strata of rung 0. The picture must have the pixels' centers.
bool ladder_enter(Ladder *ladder, Error *error);

// Fills ladder->chosen with the pixels that the strata's fractions select. The pixels with small
// requests come first. Stores the number of all these pixels in *count.
bool ladder_choose(Ladder *ladder, uint64_t *count, Error *error);
