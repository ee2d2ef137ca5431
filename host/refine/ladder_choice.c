// SPDX-License-Identifier: MIT
// Each pixel has a random number in [0, 1) on each rung: a hash of the pixel and the rung. Pixels
// whose number is below their stratum's fraction are selected. After their samples, they move to
// another stratum. If the fraction rises later, it selects only further pixels.
//
// Selected pixels are listed block by block, because rays of nearby pixels traverse the tree
// together. With lists in row order, pictures took 3 to 10 % longer.
//
// Invariant: the list depends only on the strata, their fractions and the pixels' positions. Each
// row of blocks has its own part of the list.
#include "refine/ladder_choice.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

// The side of a block of pixels.
#define CHOICE_SIDE 8

typedef struct {
    Ladder *ladder;
    // A pixel is selected if the upper bits of its hash are below its stratum's limit. The limit is
    // 0 if no further pixel is to be selected.
    uint64_t limits[STRATA_COUNT];
    uint8_t selects[STRATA_COUNT]; // whether the limit exceeds 0
    uint32_t *counts;              // selected pixels in each row of blocks
} Choosing;

// The number of upper hash bits that are compared with a limit.
#define HASH_BITS 53

// Converts the strata's fractions into limits. If a stratum's fraction and pixels have not
// changed, it has no new pixel to select. Skipping these strata avoids most hashes. Returns false
// if no stratum selects pixels.
static bool set_limits(Choosing *choosing)
{
    bool is_any = false;
    for (uint32_t i = 0; i < STRATA_COUNT; i++) {
        const Stratum *now = &choosing->ladder->statistics.strata[i];
        Stratum *before = &choosing->ladder->chosen_by.strata[i];
        const bool is_same = now->fraction == before->fraction && now->entered == before->entered;
        choosing->limits[i] = is_same ? 0 : (uint64_t)ceil(ldexp(now->fraction, HASH_BITS));
        choosing->selects[i] = choosing->limits[i] > 0;
        is_any = is_any || choosing->selects[i];
        *before = *now;
    }
    return is_any;
}

static bool is_selected(const Choosing *choosing, uint32_t pixel)
{
    const uint32_t stratum = choosing->ladder->strata[pixel];
    const uint64_t limit = choosing->limits[stratum];
    const uint32_t rung = strata_rung(stratum);
    return limit > 0 &&
           XXH3_64bits_withSeed(&pixel, sizeof pixel, rung) >> (64 - HASH_BITS) < limit;
}

// Appends each selected pixel from `first` to `end` - 1. Returns the end of the list.
static uint32_t *choose_run(const Choosing *choosing, uint32_t first, uint32_t end,
                            uint32_t *chosen)
{
    for (uint32_t pixel = first; pixel < end; pixel++)
        if (is_selected(choosing, pixel))
            *chosen++ = pixel;
    return chosen;
}

// Returns whether any pixel in a row of a block may be selected. Many rows have the same strata, so
// *rejected holds the strata of the latest row for which the result was false.
static bool row_selects(const Choosing *choosing, const uint8_t strata[CHOICE_SIDE],
                        uint64_t *rejected)
{
    uint64_t row;
    uint32_t selects = 0;
    memcpy(&row, strata, sizeof row);
    if (row == *rejected)
        return false;
    for (uint32_t i = 0; i < CHOICE_SIDE; i++)
        selects |= choosing->selects[strata[i]];
    if (selects == 0)
        *rejected = row;
    return selects != 0;
}

static uint32_t *choose_block(const Choosing *choosing, uint32_t left, uint32_t top,
                              uint64_t *rejected, uint32_t *chosen)
{
    const Ladder *ladder = choosing->ladder;
    const uint32_t width = ladder->picture->width, height = ladder->picture->height;
    const uint32_t count = width - left < CHOICE_SIDE ? width - left : CHOICE_SIDE;
    for (uint32_t y = top; y < top + CHOICE_SIDE && y < height; y++) {
        const uint32_t first = y * width + left;
        if (count < CHOICE_SIDE || row_selects(choosing, &ladder->strata[first], rejected))
            chosen = choose_run(choosing, first, first + count, chosen);
    }
    return chosen;
}

static void choose_rows(void *context, uint32_t first, uint32_t end)
{
    const Choosing *choosing = context;
    const uint32_t width = choosing->ladder->picture->width;
    uint64_t rejected = UINT64_MAX; // no row has these strata
    for (uint32_t row = first; row < end; row++) {
        uint32_t *start = choosing->ladder->chosen + (size_t)row * CHOICE_SIDE * width;
        uint32_t *chosen = start;
        for (uint32_t left = 0; left < width; left += CHOICE_SIDE)
            chosen = choose_block(choosing, left, row * CHOICE_SIDE, &rejected, chosen);
        choosing->counts[row] = (uint32_t)(chosen - start);
    }
}

// Moves the selected pixels of all rows to the start of the array. Returns their number.
static uint64_t join_rows(const Choosing *choosing, uint32_t rows)
{
    uint32_t *pixels = choosing->ladder->chosen;
    const size_t row_pixels = (size_t)CHOICE_SIDE * choosing->ladder->picture->width;
    uint64_t count = 0;
    for (uint32_t row = 0; row < rows; row++) {
        memmove(pixels + count, pixels + row * row_pixels, choosing->counts[row] * sizeof *pixels);
        count += choosing->counts[row];
    }
    return count;
}

bool ladder_choose(Ladder *ladder, uint64_t *count, Error *error)
{
    const uint32_t rows = range_count(ladder->picture->height, CHOICE_SIDE);
    Choosing choosing = {.ladder = ladder,
                         .counts = memory_raw(rows, sizeof *choosing.counts, error)};
    *count = 0;
    if (choosing.counts == NULL)
        return false;
    if (set_limits(&choosing)) {
        thread_pool_share(ladder->requests.pool, rows, 1, choose_rows, &choosing);
        *count = join_rows(&choosing, rows);
    }
    free(choosing.counts);
    return true;
}
