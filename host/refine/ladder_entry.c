// SPDX-License-Identifier: MIT
// Assigns each pixel to a stratum of rung 0 by its bend (defined below), by the bends nearby, and
// by whether a thin part touches it. The picture is processed in small areas, which stay in the
// cache. The features (squared bends) of a row of areas are summed in order, and one thread then
// adds the rows' sums in order. The result therefore does not depend on threads.
#include "refine/ladder_entry.h"

#include "refine/thin_parts.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// The bend of a pixel is the largest |2 c - a - b|. Here c is a channel of the pixel, and a and b
// are this channel of two opposite neighbors in the row, the column or a diagonal. Pairs with a
// neighbor outside of the picture do not count.

// The size of an area without its margin of RADIUS pixels on each side.
#define AREA_WIDTH  60
#define AREA_HEIGHT 32
#define RADIUS      2

// A task has at least this many pixels, because waking a thread takes longer than processing a
// small picture.
#define TASK_PIXELS (1u << 16)

// Statistics by stratum, for the pixels in one row of areas.
typedef struct {
    uint32_t pixels[BEND_CLASSES];
    double features[BEND_CLASSES]; // sums
} Entries;

typedef struct {
    Ladder *ladder;
    Entries *entries; // of each row of areas
    ThinParts thin_parts;
} Entering;

// The bends of an area with its margin; 0 outside of the picture.
typedef struct {
    uint32_t left, top; // of the area without its margin
    float bends[AREA_HEIGHT + 2 * RADIUS][AREA_WIDTH + 2 * RADIUS];
} Area;

// A range of columns and rows.
typedef struct {
    uint32_t left, right, top, bottom;
} PixelRange;

static float larger(float one, float other)
{
    return one > other ? one : other;
}

// The distances from a pixel to its neighbors in the picture's array, counted in floats. At the
// picture's border, a distance is 0. The pixel is then its own neighbor on both sides, and these
// neighbors add nothing to the bend.
typedef struct {
    ptrdiff_t right, down;
} Neighbors;

static inline float bend_along(const float *color, ptrdiff_t step)
{
    return fabsf(2 * *color - color[-step] - color[step]);
}

// Measures the bends of up to AREA_WIDTH + 2 * RADIUS pixels of a row. All of them have neighbors
// at the distances `next`.
static void measure_pixels(const float *colors, Neighbors next, uint32_t count, float *bends)
{
    float most[3 * (AREA_WIDTH + 2 * RADIUS)];
    for (uint32_t i = 0; i < 3 * count; i++)
        most[i] =
            larger(larger(bend_along(&colors[i], next.right), bend_along(&colors[i], next.down)),
                   larger(bend_along(&colors[i], next.down + next.right),
                          bend_along(&colors[i], next.down - next.right)));
    for (uint32_t i = 0; i < count; i++)
        bends[i] = larger(larger(most[3 * i], most[3 * i + 1]), most[3 * i + 2]);
}

// Measures the bends of the pixels `first` to `end` - 1 of row y.
static void measure_row(const Framebuffer *picture, uint32_t y, uint32_t first, uint32_t end,
                        float *bends)
{
    const uint32_t width = picture->width;
    const float(*colors)[3] = (const float(*)[3]) & picture->pixels[(size_t)y * width];
    const bool is_inside = y > 0 && y + 1 < picture->height;
    const Neighbors edge = {0, is_inside ? 3 * (ptrdiff_t)width : 0}, inner = {3, edge.down};
    const uint32_t left = first > 0 ? first : 1, right = end < width ? end : width - 1;
    if (first == 0)
        measure_pixels(colors[0], edge, 1, bends);
    if (left < right)
        measure_pixels(colors[left], inner, right - left, bends + (left - first));
    if (end == width)
        measure_pixels(colors[width - 1], edge, 1, bends + (width - 1 - first));
}

// Returns the picture's pixels in the area and in a margin around it.
static PixelRange pixels_of(const Framebuffer *picture, const Area *area, uint32_t margin)
{
    const uint32_t right = area->left + AREA_WIDTH + margin,
                   bottom = area->top + AREA_HEIGHT + margin;
    return (PixelRange){area->left < margin ? 0 : area->left - margin,
                        right < picture->width ? right : picture->width,
                        area->top < margin ? 0 : area->top - margin,
                        bottom < picture->height ? bottom : picture->height};
}

// Returns whether all pixels in the range have the same color.
static bool is_plain(const Framebuffer *picture, const PixelRange *range)
{
    const size_t color = sizeof *picture->pixels, row = color * picture->width;
    const size_t size = color * (range->right - range->left - 1);
    const char *left = (const char *)picture->pixels + range->top * row + range->left * color;
    const char *first = left;
    for (uint32_t y = range->top; y < range->bottom; y++, left += row)
        if (memcmp(left, first, color) != 0 || memcmp(left, left + color, size) != 0)
            return false;
    return true;
}

static void measure_area(const Framebuffer *picture, Area *area)
{
    const PixelRange colors = pixels_of(picture, area, RADIUS + 1);
    const PixelRange range = pixels_of(picture, area, RADIUS);
    memset(area->bends, 0, sizeof area->bends);
    if (is_plain(picture, &colors))
        return;
    for (uint32_t y = range.top; y < range.bottom; y++)
        measure_row(picture, y, range.left, range.right,
                    &area->bends[y + RADIUS - area->top][range.left + RADIUS - area->left]);
}

// Fills `nearby` with the largest bend among the 5 x 5 pixels around each pixel of a row.
static void spread_bends(const Area *area, uint32_t row, float nearby[AREA_WIDTH])
{
    float columns[AREA_WIDTH + 2 * RADIUS] = {0};
    for (uint32_t i = 0; i <= 2 * RADIUS; i++)
        for (uint32_t x = 0; x < AREA_WIDTH + 2 * RADIUS; x++)
            columns[x] = larger(columns[x], area->bends[row + i][x]);
    for (uint32_t x = 0; x < AREA_WIDTH; x++)
        nearby[x] = larger(larger(larger(columns[x], columns[x + 1]), columns[x + 2]),
                           larger(columns[x + 3], columns[x + 4]));
}

// Adds `count` consecutive pixels, from (x, y) on, to `entries`, and adds the pixels' strata to the
// masks of their blocks.
static void count_pixels(const Ladder *ladder, uint32_t x, uint32_t y, uint32_t count,
                         Entries *entries)
{
    const size_t first = (size_t)y * ladder->setup.picture->width + x;
    const uint8_t *strata = &ladder->strata[first];
    for (uint32_t i = 0; i < count;) {
        const uint32_t start = i, stratum = strata[i];
        double features = 0;
        for (; i < count && strata[i] == stratum; i++)
            features += (double)ladder->places[first + i].feature;
        entries->pixels[stratum] += i - start;
        entries->features[stratum] += features;
        for (uint32_t left = x + start - (x + start) % LADDER_BLOCK; left < x + i;
             left += LADDER_BLOCK)
            *ladder_block(ladder, left, y) |= ladder_stratum_bit(stratum);
    }
}

static void enter_row(const Entering *entering, const Area *area, uint32_t row, Entries *entries)
{
    const Ladder *ladder = entering->ladder;
    const ThinParts *parts = &entering->thin_parts;
    const uint32_t width = ladder->setup.picture->width, y = area->top + row;
    const uint32_t count = width - area->left < AREA_WIDTH ? width - area->left : AREA_WIDTH;
    const float *bends = &area->bends[row + RADIUS][RADIUS];
    uint8_t *strata = &ladder->strata[(size_t)y * width + area->left];
    LadderPlace *places = &ladder->places[(size_t)y * width + area->left];
    float nearby[AREA_WIDTH];
    uint32_t numbers[AREA_WIDTH]; // an array of 32-bit numbers, so that compilers vectorize the
                                  // next loop
    spread_bends(area, row, nearby);
    for (uint32_t x = 0; x < AREA_WIDTH; x++)
        numbers[x] = strata_of_bend(bends[x], nearby[x], false);
    for (uint32_t x = 0; x < count; x++)
        strata[x] = (uint8_t)numbers[x];
    for (uint32_t x = 0; x < count; x++)
        places[x].feature = bends[x] * bends[x];
    for (uint32_t x = 0; x < count && parts->touched > 0; x++)
        if (parts->axes[y * width + area->left + x] != THIN_NONE)
            strata[x] = (uint8_t)strata_of_bend(bends[x], nearby[x], true);
    count_pixels(ladder, area->left, y, count, entries);
}

// Assigns the pixels of a row of areas to strata.
static void enter_areas(const Entering *entering, uint32_t number)
{
    const Ladder *ladder = entering->ladder;
    const Framebuffer *picture = ladder->setup.picture;
    const uint32_t left_over = picture->height - number * AREA_HEIGHT;
    const uint32_t rows = left_over < AREA_HEIGHT ? left_over : AREA_HEIGHT;
    Area area = {.top = number * AREA_HEIGHT};
    memset(ladder_block(ladder, 0, area.top), 0,
           (size_t)range_count(rows, LADDER_BLOCK) * range_count(picture->width, LADDER_BLOCK) *
               sizeof *ladder->blocks);
    for (; area.left < picture->width; area.left += AREA_WIDTH) {
        measure_area(picture, &area);
        for (uint32_t row = 0; row < rows; row++)
            enter_row(entering, &area, row, &entering->entries[number]);
    }
}

static void enter_rows(void *context, uint32_t first, uint32_t end)
{
    for (; first < end; first++)
        enter_areas(context, first);
}

static void enter_all(const Entering *entering)
{
    Ladder *ladder = entering->ladder;
    const uint32_t rows = range_count(ladder->setup.picture->height, AREA_HEIGHT);
    const uint32_t part = TASK_PIXELS / (AREA_HEIGHT * ladder->setup.picture->width) + 1;
    thread_pool_share(ladder->setup.pool, rows, part, enter_rows, (void *)entering);
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t stratum = 0; stratum < BEND_CLASSES; stratum++)
            strata_enter(&ladder->statistics, stratum, entering->entries[row].pixels[stratum],
                         entering->entries[row].features[stratum]);
}

bool ladder_enter(Ladder *ladder, Error *error)
{
    const uint32_t tasks = range_count(ladder->setup.picture->height, AREA_HEIGHT);
    Entering entering = {.ladder = ladder,
                         .entries = memory_zeroed(tasks, sizeof *entering.entries, error)};
    const bool ok =
        entering.entries != NULL &&
        thin_parts_make(&entering.thin_parts, &ladder->setup, &ladder->frame, false, error);
    if (ok)
        enter_all(&entering);
    free(entering.entries);
    thin_parts_free(&entering.thin_parts);
    return ok;
}
