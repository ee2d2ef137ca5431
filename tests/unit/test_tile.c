// SPDX-License-Identifier: MIT
// Parts share the tiles of a picture evenly, wherever the costly tiles are.
#include "render/renderer.h"
#include "unit/cmocka_all.h"

#include <stdlib.h>

#define SIDE 64

// With fewer tiles per part, clrt prints a note. docs/long-jobs.md has the ratios of real scenes.
#define PART_TILES    128
#define SLOWEST_RATIO 1.25

static RenderSettings settings_of(uint32_t columns, uint32_t rows, uint32_t parts)
{
    return (RenderSettings){.width = columns * SIDE - 1,
                            .height = rows * SIDE - 1,
                            .tile_width = SIDE,
                            .tile_height = SIDE,
                            .parts = parts};
}

TEST(each_tile_is_in_one_part)
{
    static const uint32_t sizes[][3] = {{1, 1, 1}, {4, 6, 3},   {64, 64, 64}, {16, 9, 7},
                                        {3, 2, 9}, {100, 1, 8}, {1, 100, 8},  {97, 55, 100}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const uint32_t columns = sizes[i][0], rows = sizes[i][1];
        RenderSettings settings = settings_of(columns, rows, sizes[i][2]);
        unsigned char *found = calloc((size_t)columns * rows, 1);
        uint64_t all = 0;
        assert_non_null(found);
        for (settings.part = 0; settings.part < settings.parts; settings.part++) {
            const uint64_t count = tile_count(&settings);
            for (uint64_t number = 0; number < count; number++) {
                const Tile tile = tile_at(&settings, number);
                const size_t place = (size_t)(tile.y / SIDE) * columns + tile.x / SIDE;
                assert_in_range(place, 0, columns * rows - 1);
                assert_int_equal(found[place]++, 0);
            }
            all += count;
        }
        assert_int_equal(all, columns * rows);
        free(found);
    }
}

typedef double Cost(double x, double y);

static double flat(double x, double y)
{
    return 1 + 0 * x * y;
}

static double left_half(double x, double y)
{
    return (x < 0.5) + 0 * y;
}

static double sky(double x, double y)
{
    return 0.05 + (y > 0.6) + 0 * x;
}

static double disc(double x, double y)
{
    return 0.1 + ((x - 0.6) * (x - 0.6) + (y - 0.4) * (y - 0.4) < 0.06);
}

// Returns the cost of the slowest part, divided by the mean cost.
static double slowest(RenderSettings settings, Cost *cost)
{
    double most = 0, sum = 0;
    for (settings.part = 0; settings.part < settings.parts; settings.part++) {
        double own = 0;
        const uint64_t count = tile_count(&settings);
        for (uint64_t number = 0; number < count; number++) {
            const Tile tile = tile_at(&settings, number);
            own += cost((double)tile.x / settings.width, (double)tile.y / settings.height);
        }
        most = own > most ? own : most;
        sum += own;
    }
    return most / (sum / settings.parts);
}

TEST(no_part_is_much_slower_than_the_mean)
{
    static Cost *const costs[] = {flat, left_half, sky, disc};
    static const uint32_t columns[] = {30, 47, 64, 94, 128, 193};
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        for (uint32_t parts = 4; parts <= 128; parts += 4)
            for (size_t j = 0; parts * PART_TILES <= columns[i] * columns[i] && j < 4; j++) {
                const RenderSettings settings = settings_of(columns[i], columns[i], parts);
                const double ratio = slowest(settings, costs[j]);
                if (ratio > SLOWEST_RATIO)
                    fail_msg("%u columns, %u parts, cost %zu: %.2f", columns[i], parts, j, ratio);
            }
}
