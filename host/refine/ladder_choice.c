// SPDX-License-Identifier: MIT
// Each pixel has a random number in [0, 1) on each rung: a hash of the pixel and the rung. A pixel
// is selected if its number is below the fraction of its stratum. After its samples are traced, the
// pixel moves to another stratum. Numbers never change, so a fraction that rises later only adds
// pixels.
//
// Selected pixels are listed block by block, because rays of nearby pixels traverse the tree
// together. With lists in row order, pictures took 3 to 10 % longer. The blocks of a square are in
// Morton order ("A computer oriented geodetic data base", 1966). With rows of blocks instead,
// tracing the selected pixels took up to 13 % longer.
//
// Invariant: the list depends only on the strata, their fractions and the pixels' positions. Each
// row of squares fills its own part of the list, so the order of threads does not matter.
#include "refine/ladder_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    Ladder *ladder;
    // A pixel is selected if its hash is below its stratum's limit. The limit is 0 if no further
    // pixel is to be selected.
    uint64_t limits[STRATA_COUNT];
    uint32_t seeds[STRATA_COUNT]; // of the hashes; a seed depends on the stratum's rung
    uint64_t strata;              // ladder_stratum_bit of each stratum whose limit exceeds 0
    uint32_t *counts;             // selected pixels in each row of squares
} Choosing;

// A square has SQUARE_SIDE blocks along a side. The sides of squares have SQUARE pixels.
#define SQUARE_SIDE 8
#define SQUARE      (SQUARE_SIDE * LADDER_BLOCK)

// The number of rows of squares per task. It is large, because waking threads takes longer than a
// selection in a small picture.
#define ROWS_OF_TASK 8

#define HASH_BITS 32

// Returns a hash of the bits (Wellons, "Prospecting for hash functions", 2018).
static inline uint32_t hash_of(uint32_t bits)
{
    bits = (bits ^ bits >> 16) * 0x21f0aaadu;
    bits = (bits ^ bits >> 15) * 0xd35a2d97u;
    return bits ^ bits >> 15;
}

// Converts the strata's fractions into limits. If the fraction and the pixels of a stratum have not
// changed since the latest selection, the stratum has no new pixel to select. Skipping such strata
// avoids most hashes.
static void set_limits(Choosing *choosing)
{
    for (uint32_t i = 0; i < STRATA_COUNT; i++) {
        const Stratum *now = &choosing->ladder->statistics.strata[i];
        Stratum *before = &choosing->ladder->chosen_by.strata[i];
        const bool is_same = now->fraction == before->fraction && now->entered == before->entered;
        choosing->limits[i] = is_same ? 0 : (uint64_t)ceil(ldexp(now->fraction, HASH_BITS));
        choosing->seeds[i] = hash_of(strata_rung(i) + 1);
        choosing->strata |= choosing->limits[i] > 0 ? ladder_stratum_bit(i) : 0;
        *before = *now;
    }
}

// Appends the selected pixels of a block to the list that ends at `chosen`. Returns the new end of
// the list.
static uint32_t *choose_block(const Choosing *choosing, uint32_t left, uint32_t top,
                              uint32_t *chosen)
{
    const Framebuffer *picture = choosing->ladder->setup.picture;
    for (uint32_t y = top; y < top + LADDER_BLOCK && y < picture->height; y++)
        for (uint32_t x = left; x < left + LADDER_BLOCK && x < picture->width; x++) {
            const uint32_t pixel = y * picture->width + x,
                           stratum = choosing->ladder->strata[pixel];
            const uint64_t limit = choosing->limits[stratum];
            if (limit > 0 && hash_of(pixel + choosing->seeds[stratum]) < limit)
                *chosen++ = pixel;
        }
    return chosen;
}

// Returns the bits 0, 2 and 4 of a number as the bits 0, 1 and 2.
static uint32_t even_bits(uint32_t number)
{
    return (number & 1) | (number >> 1 & 2) | (number >> 2 & 4);
}

// Lists the selected pixels of rows of squares.
static void choose_rows(void *context, uint32_t first, uint32_t end)
{
    const Choosing *choosing = context;
    const Ladder *ladder = choosing->ladder;
    const Framebuffer *picture = ladder->setup.picture;
    for (uint32_t row = first; row < end; row++) {
        uint32_t *start = ladder->chosen + (size_t)row * SQUARE * picture->width, *chosen = start;
        for (uint32_t left = 0; left < picture->width; left += SQUARE)
            for (uint32_t i = 0; i < SQUARE_SIDE * SQUARE_SIDE; i++) {
                const uint32_t x = left + LADDER_BLOCK * even_bits(i);
                const uint32_t y = row * SQUARE + LADDER_BLOCK * even_bits(i >> 1);
                if (x < picture->width && y < picture->height &&
                    (*ladder_block(ladder, x, y) & choosing->strata) != 0)
                    chosen = choose_block(choosing, x, y, chosen);
            }
        choosing->counts[row] = (uint32_t)(chosen - start);
    }
}

// Moves the selected pixels of all rows of squares to the start of the list: first the pixels with
// small requests, and then the others. Returns the number of all these pixels.
static uint64_t join_rows(const Choosing *choosing, uint32_t rows)
{
    const Ladder *ladder = choosing->ladder;
    const size_t row_pixels = (size_t)SQUARE * ladder->setup.picture->width;
    uint32_t *joined = ladder->chosen, *later = ladder->chosen + ladder->statistics.pixels;
    uint64_t count = 0, laters = 0;
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t i = 0; i < choosing->counts[row]; i++) {
            const uint32_t pixel = ladder->chosen[row * row_pixels + i];
            if (ladder_is_small(strata_rung(ladder->strata[pixel])))
                joined[count++] = pixel;
            else
                later[laters++] = pixel;
        }
    memcpy(joined + count, later, laters * sizeof *later);
    return count + laters;
}

bool ladder_choose(Ladder *ladder, uint64_t *count, Error *error)
{
    const uint32_t rows = range_count(ladder->setup.picture->height, SQUARE);
    Choosing choosing = {.ladder = ladder,
                         .counts = memory_raw(rows, sizeof *choosing.counts, error)};
    *count = 0;
    if (choosing.counts == NULL)
        return false;
    set_limits(&choosing);
    if (choosing.strata != 0) {
        thread_pool_share(ladder->setup.pool, rows, ROWS_OF_TASK, choose_rows, &choosing);
        *count = join_rows(&choosing, rows);
    }
    free(choosing.counts);
    return true;
}
