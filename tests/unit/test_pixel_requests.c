// SPDX-License-Identifier: MIT
// Tests the positions and sums of a pixel's samples.
#include "refine/pixel_requests.h"
#include "unit/cmocka_all.h"

#include <string.h>

#define HASH 0x5bd1e995u

// Points of the sequence that are XORed to the request's offset, as in kernels/ladder.cl.
static const uint32_t points[REQUEST_SAMPLES][2] = {
    {0, 0},    {512, 512}, {256, 768}, {768, 256}, {128, 640}, {640, 128}, {384, 384}, {896, 896},
    {64, 960}, {576, 448}, {320, 192}, {832, 704}, {192, 320}, {704, 832}, {448, 576}, {960, 64}};

// Stores the positions of samples first to end - 1 of a pixel in places. Each request has `samples`
// samples.
static void place(uint32_t first, uint32_t end, uint32_t samples, uint32_t places[][2])
{
    const uint32_t pixel[2] = {3, 5};
    for (uint32_t i = first; i < end; i++) {
        const uint32_t point = i % samples;
        const PixelRequest request = pixel_request(pixel, i - point, samples, HASH);
        assert_int_equal(request.x, 3);
        assert_int_equal(request.y, 5);
        assert_int_equal(request.samples, samples);
        places[i][0] = points[point][0] ^ request.offset % LADDER_GRID;
        places[i][1] = points[point][1] ^ request.offset / LADDER_GRID;
    }
}

// Requests of the first 16 samples have four samples.
static void place_all(uint32_t count, uint32_t places[][2])
{
    const uint32_t fours = count < REQUEST_SAMPLES ? count : REQUEST_SAMPLES;
    place(0, fours, 4, places);
    place(fours, count, REQUEST_SAMPLES, places);
}

// Divides the pixel into columns x rows rectangles, and expects one sample in each.
static void expect_one_in_each(uint32_t columns, uint32_t rows)
{
    static uint32_t places[LADDER_GRID][2];
    static bool is_taken[LADDER_GRID];
    const uint32_t count = columns * rows;
    place_all(count, places);
    memset(is_taken, 0, sizeof is_taken);
    for (uint32_t i = 0; i < count; i++) {
        assert_true(places[i][0] < LADDER_GRID && places[i][1] < LADDER_GRID);
        const uint32_t column = places[i][0] * columns / LADDER_GRID,
                       row = places[i][1] * rows / LADDER_GRID;
        assert_false(is_taken[row * columns + column]);
        is_taken[row * columns + column] = true;
    }
}

TEST(every_rung_has_one_sample_in_each_rectangle_of_its_size)
{
    for (uint32_t count = 4; count <= LADDER_GRID; count *= 4)
        for (uint32_t columns = 1; columns <= count; columns *= 2)
            expect_one_in_each(columns, count / columns);
}

TEST(hashes_move_the_samples)
{
    const uint32_t pixel[2] = {0, 0};
    assert_int_equal(pixel_request(pixel, 0, 4, 1).offset, 1);
    assert_int_equal(pixel_request(pixel, 0, 4, 2 * LADDER_GRID).offset, 2 * LADDER_GRID);
}

TEST(sums_give_mean_and_variance)
{
    PixelSums sums = {.squares = 0};
    // Eight of the 16 samples are black, and eight are (1, 0.5, 0).
    const PixelSums bright = {{1ull << 32, 1ull << 31, 0}, (1ull << 48) + (1ull << 46)};
    for (int i = 0; i < 8; i++)
        pixel_sums_add(&sums, &bright);
    float mean[3];
    pixel_sums_mean(&sums, 16, mean);
    assert_true(mean[0] == 0.5f && mean[1] == 0.25f && mean[2] == 0.0f);
    assert_true(pixel_sums_variance(&sums, 16) == (0.25 + 0.0625) / 3);
}
