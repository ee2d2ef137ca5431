// SPDX-License-Identifier: MIT
// Tests that parts share the tiles of a picture evenly, regardless of the positions of costly
// tiles, and that launches draw each tile once.
#include "render/renderer.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <stdlib.h>

#define SIDE 64

// For parts with fewer tiles, clrt prints a note. docs/long-jobs.md has the ratios of real scenes.
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

static Cost *const costs[] = {flat, left_half, sky, disc};
#define COSTS (sizeof costs / sizeof costs[0])

// Computes the time of the slowest part, divided by the mean time, for each cost.
static void find_slowest(RenderSettings settings, double ratios[COSTS])
{
    double most[COSTS] = {0}, sum[COSTS] = {0};
    for (settings.part = 0; settings.part < settings.parts; settings.part++) {
        double own[COSTS] = {0};
        const uint64_t count = tile_count(&settings);
        for (uint64_t number = 0; number < count; number++) {
            const Tile tile = tile_at(&settings, number);
            const double x = (double)tile.x / settings.width, y = (double)tile.y / settings.height;
            for (size_t i = 0; i < COSTS; i++)
                own[i] += costs[i](x, y);
        }
        for (size_t i = 0; i < COSTS; i++) {
            most[i] = own[i] > most[i] ? own[i] : most[i];
            sum[i] += own[i];
        }
    }
    for (size_t i = 0; i < COSTS; i++)
        ratios[i] = most[i] / (sum[i] / settings.parts);
}

TEST(no_part_is_much_slower_than_the_mean)
{
    static const uint32_t columns[] = {30, 47, 64, 94, 128, 193};
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        for (uint32_t parts = 4; parts <= 128 && parts * PART_TILES <= columns[i] * columns[i];
             parts += 4) {
            double ratios[COSTS];
            find_slowest(settings_of(columns[i], columns[i], parts), ratios);
            for (size_t j = 0; j < COSTS; j++)
                if (ratios[j] > SLOWEST_RATIO)
                    fail_msg("%u columns, %u parts, cost %zu: %.2f", columns[i], parts, j,
                             ratios[j]);
        }
}

// Counts of launches per pixel, in the framebuffer's layout.
typedef struct {
    unsigned char *counts;
    uint32_t width, height;
} Drawn;

static void draw_area(const Drawn *drawn, const Tile *area)
{
    assert_true(area->left + area->width <= drawn->width);
    assert_true(area->top + area->height <= drawn->height);
    for (uint32_t row = 0; row < area->height; row++)
        for (uint32_t column = 0; column < area->width; column++)
            drawn->counts[(size_t)(area->top + row) * drawn->width + area->left + column]++;
}

static void expect_drawn_once(const Drawn *drawn, const Tile *tile)
{
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++)
            assert_int_equal(
                drawn->counts[(size_t)(tile->top + row) * drawn->width + tile->left + column], 1);
}

// Draws a picture by launches of `least` to `most` pixels, and returns the number of launches. When
// a tile ends, each of its pixels must have been drawn once.
static unsigned count_launches(const RenderSettings *settings, uint32_t least, uint32_t most)
{
    Drawn drawn;
    TileCursor cursor = {0, 0};
    uint64_t state = most, ended, tiles = 0;
    unsigned launches = 0;
    tile_frame_size(settings, &drawn.width, &drawn.height);
    drawn.counts = calloc((size_t)drawn.width * drawn.height + 1, 1);
    assert_non_null(drawn.counts);
    for (; cursor.number < tile_count(settings); launches++) {
        const uint32_t pixels = least + random_below(&state, most - least + 1);
        const Tile area = tile_next(settings, &cursor, pixels, &ended);
        assert_true(area.width * area.height <= pixels || area.height == 1);
        draw_area(&drawn, &area);
        for (; ended > 0; ended--) {
            const Tile tile = tile_at(settings, tiles++);
            expect_drawn_once(&drawn, &tile);
        }
    }
    assert_int_equal(tiles, tile_count(settings));
    free(drawn.counts);
    return launches;
}

TEST(launches_of_any_size_draw_every_tile_once)
{
    uint64_t random = 7;
    for (uint32_t round = 0; round < 300; round++) {
        const uint32_t most = 1 + random_below(&random, 60000);
        RenderSettings settings = {.width = 1 + random_below(&random, 200),
                                   .height = 1 + random_below(&random, 200),
                                   .tile_width = 1 + random_below(&random, 100),
                                   .tile_height = 1 + random_below(&random, 100),
                                   .parts = round % 3};
        settings.part = settings.parts > 1;
        count_launches(&settings, 1 + random_below(&random, most), most);
    }
}

TEST(launches_join_and_divide_tiles_by_their_size)
{
    static const struct {
        uint32_t parts, pixels, launches;
    } cases[] = {{0, 1024 * 1024, 1},    {0, 2 * 1024 * 1024, 1}, {0, 3 * 1024 * 128, 3},
                 {0, 5 * 128 * 128, 16}, {0, 128 * 128, 64},      {0, 128 * 64, 128},
                 {0, 128 * 60, 192},     {0, 1, 64 * 128},        {2, 1024 * 1024, 32}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const RenderSettings settings = {.width = 1024,
                                         .height = 1024,
                                         .tile_width = 128,
                                         .tile_height = 128,
                                         .parts = cases[i].parts};
        assert_int_equal(count_launches(&settings, cases[i].pixels, cases[i].pixels),
                         cases[i].launches);
    }
}
