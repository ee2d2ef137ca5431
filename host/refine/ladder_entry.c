// SPDX-License-Identifier: MIT
// Assigns each pixel to a stratum of rung 0 by its bend, and by whether a thin part touches it.
// Each task sums the features of its pixels in order, and one thread then adds the tasks' sums in
// order. The result therefore does not depend on threads.
#include "refine/ladder_entry.h"

#include "refine/thin_parts.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// The bend of a pixel is the largest second difference of its colors along the row, the column and
// both diagonals.

#define ROWS_OF_TASK 16
#define RADIUS       2
#define RUN          64

typedef struct {
    const Framebuffer *picture;
    const float *bends;
    float *results;
} Measuring;

static float larger(float one, float other)
{
    return one > other ? one : other;
}

// Raises each value of `most` to at least the absolute second difference of its pixel and channel.
// Both arrays begin at the same pixel. `step` is the distance between neighbors, in pixels of the
// arrays, and `range` holds the first pixel and the end.
static void raise_bends(float *most, const float *colors, ptrdiff_t step, const uint32_t range[2])
{
    for (ptrdiff_t i = 3 * (ptrdiff_t)range[0]; i < 3 * (ptrdiff_t)range[1]; i++)
        most[i] =
            larger(most[i], fabsf(2 * colors[i] - colors[i - 3 * step] - colors[i + 3 * step]));
}

// Measures the bends of up to RUN pixels of row y from x on. Pixels at the picture's border have
// only the directions that stay inside.
static void measure_run(const Measuring *measuring, uint32_t x, uint32_t y)
{
    static const int directions[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    const uint32_t width = measuring->picture->width, height = measuring->picture->height;
    const size_t first = (size_t)y * width + x;
    const uint32_t count = width - x < RUN ? width - x : RUN;
    const uint32_t whole[2] = {0, count},
                   inner[2] = {x == 0, x + count == width ? count - 1 : count};
    float most[3 * RUN] = {0};
    for (int i = 0; i < 4; i++) {
        const int right = directions[i][0], down = directions[i][1];
        if (down == 0 || (y > 0 && y + 1 < height))
            raise_bends(most, measuring->picture->pixels[first], right + (ptrdiff_t)down * width,
                        right != 0 ? inner : whole);
    }
    for (uint32_t i = 0; i < count; i++)
        measuring->results[first + i] =
            larger(larger(most[3 * i], most[3 * i + 1]), most[3 * i + 2]);
}

static void measure_rows(void *context, uint32_t first, uint32_t end)
{
    const Measuring *measuring = context;
    for (uint32_t y = first; y < end; y++)
        for (uint32_t x = 0; x < measuring->picture->width; x += RUN)
            measure_run(measuring, x, y);
}

// Replaces each value of a row by the largest value up to two columns away. Values are at least 0.
static void spread_row(float *row, uint32_t width)
{
    float before = 0, earlier = 0; // the values of the two columns before x
    for (uint32_t x = 0; x < width; x++) {
        const float own = row[x];
        const float next = x + 1 < width ? row[x + 1] : 0, later = x + 2 < width ? row[x + 2] : 0;
        row[x] = larger(larger(larger(earlier, before), own), larger(next, later));
        earlier = before;
        before = own;
    }
}

static void spread_rows(void *context, uint32_t first, uint32_t end)
{
    const Measuring *measuring = context;
    const uint32_t width = measuring->picture->width, height = measuring->picture->height;
    for (uint32_t y = first; y < end; y++) {
        float *results = measuring->results + (size_t)y * width;
        const uint32_t last = height - y <= RADIUS ? height - 1 : y + RADIUS;
        memset(results, 0, width * sizeof *results);
        for (uint32_t row = y < RADIUS ? 0 : y - RADIUS; row <= last; row++)
            for (uint32_t x = 0; x < width; x++)
                results[x] = larger(results[x], measuring->bends[(size_t)row * width + x]);
        spread_row(results, width);
    }
}

// Fills bends, row by row, for a picture with one sample per pixel. A pixel's bend is the largest
// |2 c - a - b|, where c is a channel of the pixel, and a and b are this channel of two opposite
// neighbors. Pairs of neighbors partly outside of the picture do not count.
static void bends_measure(const Framebuffer *picture, ThreadPool *pool, float *bends)
{
    Measuring measuring = {picture, NULL, bends};
    thread_pool_share(pool, picture->height, ROWS_OF_TASK, measure_rows, &measuring);
}

// Fills nearby with the largest bend of the 5 x 5 pixels around each pixel.
static void bends_spread(const Framebuffer *picture, ThreadPool *pool, const float *bends,
                         float *nearby)
{
    Measuring measuring = {picture, bends, nearby};
    thread_pool_share(pool, picture->height, ROWS_OF_TASK, spread_rows, &measuring);
}

#define PIXELS_OF_TASK 4096

// Statistics of a task's pixels, by stratum.
typedef struct {
    uint32_t pixels[BEND_CLASSES];
    double features[BEND_CLASSES]; // sums
} Entries;

typedef struct {
    Ladder *ladder;
    float *bends, *nearby; // of each pixel
    Entries *entries;      // of each task
    ThinParts thin_parts;
} Entering;

static void enter_part(void *context, uint32_t first, uint32_t end)
{
    const Entering *entering = context;
    Ladder *ladder = entering->ladder;
    Entries entries = {.pixels = {0}};
    for (uint32_t pixel = first; pixel < end; pixel++) {
        const double bend = (double)entering->bends[pixel];
        const uint32_t stratum = strata_of_bend(bend, (double)entering->nearby[pixel],
                                                thin_parts_touch(&entering->thin_parts, pixel));
        ladder->strata[pixel] = (uint8_t)stratum;
        ladder->places[pixel].feature = (float)(bend * bend);
        entries.pixels[stratum]++;
        entries.features[stratum] += (double)ladder->places[pixel].feature;
    }
    entering->entries[first / PIXELS_OF_TASK] = entries;
}

static void enter_all(const Entering *entering)
{
    Ladder *ladder = entering->ladder;
    ThreadPool *pool = ladder->requests.pool;
    const uint32_t pixels = (uint32_t)ladder->statistics.pixels;
    bends_measure(ladder->picture, pool, entering->bends);
    bends_spread(ladder->picture, pool, entering->bends, entering->nearby);
    thread_pool_share(pool, pixels, PIXELS_OF_TASK, enter_part, (void *)entering);
    for (uint32_t task = 0; task < range_count(pixels, PIXELS_OF_TASK); task++)
        for (uint32_t stratum = 0; stratum < BEND_CLASSES; stratum++)
            strata_enter(&ladder->statistics, stratum, entering->entries[task].pixels[stratum],
                         entering->entries[task].features[stratum]);
}

// Finds the pixels that thin parts touch.
static bool find_thin_parts(ThinParts *parts, const LadderSetup *setup, Error *error)
{
    FrameData frame = renderer_frame(setup->renderer, setup->camera);
    for (int axis = 0; axis < 3; axis++) {
        frame.camera.right_step[axis] *= (float)LADDER_GRID / REFINE_GRID;
        frame.camera.down_step[axis] *= (float)LADDER_GRID / REFINE_GRID;
    }
    const ThinSource source = {
        &frame, setup->scene, setup->normalization, setup->flat->spheres, setup->pool, 1};
    return thin_parts_make(parts, &source, error);
}

bool ladder_enter(Ladder *ladder, const LadderSetup *setup, Error *error)
{
    const size_t pixels = ladder->statistics.pixels;
    const size_t tasks = range_count((uint32_t)pixels, PIXELS_OF_TASK);
    Entering entering = {.ladder = ladder,
                         .bends = memory_raw(pixels, sizeof(float), error),
                         .nearby = memory_raw(pixels, sizeof(float), error),
                         .entries = memory_raw(tasks, sizeof(Entries), error)};
    const bool ok = entering.bends != NULL && entering.nearby != NULL && entering.entries != NULL &&
                    find_thin_parts(&entering.thin_parts, setup, error);
    if (ok)
        enter_all(&entering);
    free(entering.bends);
    free(entering.nearby);
    free(entering.entries);
    thin_parts_free(&entering.thin_parts);
    return ok;
}
