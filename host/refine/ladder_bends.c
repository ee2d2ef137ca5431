// SPDX-License-Identifier: MIT
// The bend of a pixel is the largest second difference of its colors along the row, the column and
// both diagonals.
#include "refine/ladder.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

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

void bends_measure(const Framebuffer *picture, ThreadPool *pool, float *bends)
{
    Measuring measuring = {picture, NULL, bends};
    thread_pool_share(pool, picture->height, ROWS_OF_TASK, measure_rows, &measuring);
}

void bends_spread(const Framebuffer *picture, ThreadPool *pool, const float *bends, float *nearby)
{
    Measuring measuring = {picture, bends, nearby};
    thread_pool_share(pool, picture->height, ROWS_OF_TASK, spread_rows, &measuring);
}
