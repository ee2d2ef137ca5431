// SPDX-License-Identifier: MIT
// Computes second differences along rows, columns and both diagonals.
#include "refine/ladder.h"

#include <math.h>
#include <stddef.h>

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

static uint32_t range_begin(uint32_t middle)
{
    return middle < RADIUS ? 0 : middle - RADIUS;
}

static uint32_t range_end(uint32_t middle, uint32_t count)
{
    return count - middle <= RADIUS ? count : middle + RADIUS + 1;
}

static float largest_around(const Measuring *measuring, uint32_t x, uint32_t y)
{
    const uint32_t width = measuring->picture->width, height = measuring->picture->height;
    float largest = 0;
    for (uint32_t row = range_begin(y); row < range_end(y, height); row++)
        for (uint32_t column = range_begin(x); column < range_end(x, width); column++) {
            const float bend = measuring->bends[(size_t)row * width + column];
            largest = bend > largest ? bend : largest;
        }
    return largest;
}

static void spread_rows(void *context, uint32_t first, uint32_t end)
{
    const Measuring *measuring = context;
    const uint32_t width = measuring->picture->width;
    for (uint32_t y = first; y < end; y++)
        for (uint32_t x = 0; x < width; x++)
            measuring->results[(size_t)y * width + x] = largest_around(measuring, x, y);
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
