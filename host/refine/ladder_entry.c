// SPDX-License-Identifier: MIT
// Assigns each pixel to a stratum of rung 0 by its bend (defined below), by the bends nearby, and
// by whether a thin part touches it. Threads first measure all bends. They then sum the features
// (squared bends) of each band of rows in order, and one thread adds the bands' sums in order. The
// result therefore does not depend on threads.
#include "refine/ladder_state.h"

#include "refine/thin_parts.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// The bend of a pixel is the largest |2 c - a - b|. Here c is a channel of the pixel, and a and b
// are this channel of two opposite neighbors in the row, the column or a diagonal. Pairs with a
// neighbor outside of the picture do not count.

// Bends spread over this number of pixels in each direction.
#define RADIUS 2

// Rows are processed in parts of up to PART_PIXELS pixels.
#define PART_PIXELS 60

// A task has at least this many pixels, because waking a thread takes longer than processing a
// small picture.
#define TASK_PIXELS (1u << 16)

// The rows of a band. The bands' statistics are summed in order.
#define BAND_ROWS 32

// Statistics by stratum, for the pixels of a band.
typedef struct {
    uint32_t pixels[BEND_CLASSES];
    double features[BEND_CLASSES]; // sums
} Entries;

typedef struct {
    Ladder *ladder;
    Entries *entries; // of each band
    ThinParts thin_parts;
} Entering;

static float larger(float one, float other)
{
    return one > other ? one : other;
}

static uint32_t smaller(uint32_t one, uint32_t other)
{
    return one < other ? one : other;
}

static inline float bend_along(const float *color, ptrdiff_t step)
{
    return fabsf(2 * *color - color[-step] - color[step]);
}

// Measures the bends of up to PART_PIXELS pixels of a row. `right` and `down` are the distances
// from a pixel to its neighbors in the picture's array, counted in floats. At the picture's border,
// a distance is 0. The pixel is then its own neighbor on both sides, and these neighbors add
// nothing to the bend.
static void measure_pixels(const float *colors, ptrdiff_t right, ptrdiff_t down, uint32_t count,
                           LadderPlace *places)
{
    float most[3 * PART_PIXELS];
    for (uint32_t i = 0; i < 3 * count; i++)
        most[i] = larger(
            larger(bend_along(&colors[i], right), bend_along(&colors[i], down)),
            larger(bend_along(&colors[i], down + right), bend_along(&colors[i], down - right)));
    for (uint32_t i = 0; i < count; i++)
        places[i].bend = larger(larger(most[3 * i], most[3 * i + 1]), most[3 * i + 2]);
}

static void measure_rows(void *context, uint32_t first, uint32_t end)
{
    const Ladder *ladder = context;
    const Framebuffer *picture = ladder->setup.picture;
    const uint32_t width = picture->width;
    for (uint32_t y = first; y < end; y++) {
        const bool is_inside = y > 0 && y + 1 < picture->height;
        const ptrdiff_t down = is_inside ? 3 * (ptrdiff_t)width : 0;
        const float(*colors)[3] = (const float(*)[3]) & picture->pixels[(size_t)y * width];
        LadderPlace *places = &ladder->places[(size_t)y * width];
        measure_pixels(colors[0], 0, down, 1, places);
        for (uint32_t x = 1; x + 1 < width; x += PART_PIXELS)
            measure_pixels(colors[x], 3, down, smaller(width - 1 - x, PART_PIXELS), &places[x]);
        measure_pixels(colors[width - 1], 0, down, 1, &places[width - 1]);
    }
}

// Fills `nearby` with the largest bend among the 5 x 5 pixels around each pixel from (x, y) on.
static void spread_bends(const Ladder *ladder, uint32_t x, uint32_t y, float nearby[PART_PIXELS])
{
    const uint32_t width = ladder->setup.picture->width, height = ladder->setup.picture->height;
    const uint32_t left = x - smaller(x, RADIUS), right = smaller(x + PART_PIXELS + RADIUS, width);
    const uint32_t top = y - smaller(y, RADIUS), bottom = smaller(y + 1 + RADIUS, height);
    float columns[PART_PIXELS + 2 * RADIUS] = {0}, *start = columns + RADIUS + left - x;
    for (uint32_t row = top; row < bottom; row++)
        for (uint32_t i = 0; i < right - left; i++)
            start[i] = larger(start[i], ladder->places[(size_t)row * width + left + i].bend);
    for (uint32_t i = 0; i < PART_PIXELS; i++)
        nearby[i] = larger(larger(larger(columns[i], columns[i + 1]), columns[i + 2]),
                           larger(columns[i + 3], columns[i + 4]));
}

// Adds `count` consecutive pixels, from (x, y) on, to `entries`, and adds the pixels' strata to the
// masks of their blocks.
static void count_pixels(const Ladder *ladder, uint32_t x, uint32_t y, uint32_t count,
                         Entries *entries)
{
    const size_t first = (size_t)y * ladder->setup.picture->width + x;
    const uint8_t *strata = &ladder->strata[first];
    const LadderPlace *places = &ladder->places[first];
    for (uint32_t i = 0; i < count;) {
        const uint32_t start = i, stratum = strata[i];
        double features = 0;
        for (; i < count && strata[i] == stratum; i++)
            features += (double)(places[i].bend * places[i].bend);
        entries->pixels[stratum] += i - start;
        entries->features[stratum] += features;
        for (uint32_t left = x + start - (x + start) % LADDER_BLOCK; left < x + i;
             left += LADDER_BLOCK)
            *ladder_block(ladder, left, y) |= ladder_stratum_bit(stratum);
    }
}

// Assigns up to PART_PIXELS pixels of a row, from (x, y) on, to strata.
static void enter_part(const Entering *entering, uint32_t x, uint32_t y, Entries *entries)
{
    const Ladder *ladder = entering->ladder;
    const ThinParts *parts = &entering->thin_parts;
    const uint32_t width = ladder->setup.picture->width, count = smaller(width - x, PART_PIXELS);
    const size_t first = (size_t)y * width + x;
    const LadderPlace *places = &ladder->places[first];
    uint8_t *strata = &ladder->strata[first];
    float nearby[PART_PIXELS];
    uint32_t numbers[PART_PIXELS]; // an array of 32-bit numbers, so that compilers vectorize the
                                   // next loop
    spread_bends(ladder, x, y, nearby);
    for (uint32_t i = 0; i < count; i++)
        numbers[i] = strata_of_bend(places[i].bend, nearby[i], false);
    for (uint32_t i = 0; i < count; i++)
        strata[i] = (uint8_t)numbers[i];
    for (uint32_t i = 0; i < count && parts->touched > 0; i++)
        if (parts->axes[first + i] != THIN_NONE)
            strata[i] = (uint8_t)strata_of_bend(places[i].bend, nearby[i], true);
    count_pixels(ladder, x, y, count, entries);
}

static void enter_bands(void *context, uint32_t first, uint32_t end)
{
    const Entering *entering = context;
    const Framebuffer *picture = entering->ladder->setup.picture;
    const uint32_t bottom = smaller(end * BAND_ROWS, picture->height);
    for (uint32_t y = first * BAND_ROWS; y < bottom; y++)
        for (uint32_t x = 0; x < picture->width; x += PART_PIXELS)
            enter_part(entering, x, y, &entering->entries[y / BAND_ROWS]);
}

bool ladder_enter(Ladder *ladder, Error *error)
{
    const uint32_t height = ladder->setup.picture->height, bands = range_count(height, BAND_ROWS);
    const uint32_t rows = TASK_PIXELS / ladder->setup.picture->width;
    ThreadPool *pool = ladder->setup.pool;
    Entering entering = {.ladder = ladder,
                         .entries = memory_zeroed(bands, sizeof *entering.entries, error)};
    const bool ok =
        entering.entries != NULL &&
        thin_parts_make(&entering.thin_parts, &ladder->setup, &ladder->frame, false, error);
    if (ok) {
        thread_pool_share(pool, height, rows + 1, measure_rows, ladder);
        thread_pool_share(pool, bands, rows / BAND_ROWS + 1, enter_bands, &entering);
    }
    for (uint32_t band = 0; ok && band < bands; band++)
        for (uint32_t stratum = 0; stratum < BEND_CLASSES; stratum++)
            strata_enter(&ladder->statistics, stratum, entering.entries[band].pixels[stratum],
                         entering.entries[band].features[stratum]);
    free(entering.entries);
    thin_parts_free(&entering.thin_parts);
    return ok;
}
