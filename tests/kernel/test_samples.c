// SPDX-License-Identifier: MIT
// Tests the positions of a pixel's samples in kernels/samples.cl.
#include "kernel/probe.h"
#include "unit/cmocka_all.h"

#include <math.h>

// The side of a pixel. The unit of positions is half a sub-pixel.
#define SIDE (2 * LADDER_GRID)

static Probe probe;

// Stores the positions of the samples of `count` requests. Each request has `samples` samples.
static void trace(const PixelRequest *requests, uint32_t count, uint32_t samples,
                  uint32_t places[][2])
{
    const size_t all = (size_t)count * samples;
    const ProbeInput inputs[2] = {{requests, count * sizeof *requests}, {&samples, sizeof samples}};
    assert_true(
        probe_run(&probe, "probe_places", inputs, all, (ProbeInput){places, all * sizeof *places}));
}

// Stores the positions of the first LADDER_GRID samples of a pixel. Each request takes `samples` of
// them.
static void place_all(uint32_t x, uint32_t y, uint32_t samples, uint32_t places[LADDER_GRID][2])
{
    PixelRequest requests[LADDER_GRID];
    for (uint32_t i = 0; i < LADDER_GRID / samples; i++)
        requests[i] = (PixelRequest){x, y, i * samples};
    trace(requests, LADDER_GRID / samples, samples, places);
}

// Divides the pixel into columns x rows rectangles, and expects one of the first columns * rows
// samples in each.
static void expect_one_in_each(uint32_t places[][2], uint32_t columns, uint32_t rows)
{
    bool is_taken[LADDER_GRID] = {false};
    for (uint32_t i = 0; i < columns * rows; i++) {
        assert_true(places[i][0] < SIDE && places[i][1] < SIDE);
        const uint32_t column = places[i][0] * columns / SIDE, row = places[i][1] * rows / SIDE;
        assert_false(is_taken[row * columns + column]);
        is_taken[row * columns + column] = true;
    }
}

TEST(every_rung_has_one_sample_in_each_rectangle_of_its_size)
{
    static uint32_t places[LADDER_GRID][2];
    for (uint32_t pixel = 0; pixel < 20; pixel++) {
        place_all(pixel, 3 * pixel, LARGE_SAMPLES, places);
        for (uint32_t count = 4; count <= LADDER_GRID; count *= 2)
            for (uint32_t columns = 1; columns <= count; columns *= 2)
                expect_one_in_each(places, columns, count / columns);
    }
}

TEST(positions_do_not_depend_on_the_sizes_of_requests)
{
    static uint32_t fours[LADDER_GRID][2], places[LADDER_GRID][2];
    place_all(7, 1000, 4, fours);
    place_all(7, 1000, LARGE_SAMPLES, places);
    assert_memory_equal(fours, places, sizeof places);
}

// The last test compares the first COUNT samples of PIXELS pixels.
#define PIXELS 4096
#define COUNT  4

// Divides the pixel into COUNT equal parts along an axis. Returns a sample's position in its part,
// from -0.5 to 0.5.
static double offset_of(uint32_t place)
{
    return place % (SIDE / COUNT) / (double)(SIDE / COUNT) - 0.5;
}

// With random offsets, the correlation of two samples has a standard deviation of 1/64. If one
// number per pixel were XORed with all points, some pairs of samples would have equal offsets.
TEST(samples_of_a_pixel_share_no_offset)
{
    static PixelRequest requests[PIXELS];
    static uint32_t places[PIXELS * COUNT][2];
    for (uint32_t i = 0; i < PIXELS; i++)
        requests[i] = (PixelRequest){i % 64, i / 64, 0};
    trace(requests, PIXELS, COUNT, places);
    for (int axis = 0; axis < 2; axis++)
        for (uint32_t one = 0; one < COUNT; one++)
            for (uint32_t other = 0; other < one; other++) {
                double sum = 0;
                for (uint32_t i = 0; i < PIXELS * COUNT; i += COUNT)
                    sum += offset_of(places[i + one][axis]) * offset_of(places[i + other][axis]);
                assert_true(fabs(12 * sum / PIXELS) < 5.0 / 64);
            }
}

SET_UP(open_probe)
{
    return probe_begin(&probe, CLRT_SOURCE_FOLDER "/tests/kernel/samples.cl", CLRT_FP32);
}

TEAR_DOWN(close_probe)
{
    probe_close(&probe);
    return 0;
}
