// SPDX-License-Identifier: MIT
// Computes second differences along rows, columns and both diagonals.
#include "refine/ladder.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define ROWS_OF_TASK 16
#define RADIUS       2

typedef struct {
    const Framebuffer *picture;
    const float *bends;
    float *results;
} Measuring;

static float bend_between(const float color[3], const float one[3], const float other[3])
{
    float largest = 0;
    for (int channel = 0; channel < 3; channel++) {
        const float bend = fabsf(2 * color[channel] - one[channel] - other[channel]);
        largest = bend > largest ? bend : largest;
    }
    return largest;
}

static float bend_at(const Framebuffer *picture, uint32_t x, uint32_t y)
{
    static const int directions[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    const bool has_columns = x > 0 && x + 1 < picture->width;
    const bool has_rows = y > 0 && y + 1 < picture->height;
    float(*pixel)[3] = &picture->pixels[(size_t)y * picture->width + x];
    float largest = 0;
    for (int i = 0; i < 4; i++) {
        const int right = directions[i][0], down = directions[i][1];
        const ptrdiff_t step = right + (ptrdiff_t)down * picture->width;
        if ((right != 0 && !has_columns) || (down != 0 && !has_rows))
            continue;
        const float bend = bend_between(pixel[0], pixel[-step], pixel[step]);
        largest = bend > largest ? bend : largest;
    }
    return largest;
}

static void measure_rows(void *context, uint32_t first, uint32_t end)
{
    const Measuring *measuring = context;
    const uint32_t width = measuring->picture->width;
    for (uint32_t y = first; y < end; y++)
        for (uint32_t x = 0; x < width; x++)
            measuring->results[(size_t)y * width + x] = bend_at(measuring->picture, x, y);
}

static float larger(float one, float other)
{
    return one > other ? one : other;
}

// Replaces each value of a row by the largest of the values up to two columns away. Values are
// at least 0.
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
