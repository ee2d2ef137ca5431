// SPDX-License-Identifier: MIT
// Computes the colors of pixels and samples. A program consists of this file and the file of a
// kernel, such as tile.cl.
// With pair nodes, a work-item has one pixel. With wide nodes, it has a block of BLOCK x BLOCK
// pixels, and traces PACKETS packets of these pixels at a time.
//
// Invariant: colors are rounded to integer steps of 2^-32 and summed as integers. A pixel's color
// therefore does not depend on the order of its samples, or on how pixels are assigned to
// work-items.
#include "trace.cl"

#if CLRT_LANES == 1
#define PACKET_WIDTH  1
#define PACKET_HEIGHT 1
#define BLOCK         1
#define LANE_X        0
#define LANE_Y        0
#elif CLRT_LANES == 4
#define PACKET_WIDTH  2
#define PACKET_HEIGHT 2
#define BLOCK         BLOCK_SIDE
#define LANE_X        (uint4)(0, 1, 0, 1)
#define LANE_Y        (uint4)(0, 0, 1, 1)
#elif CLRT_LANES == 8
#define PACKET_WIDTH  4
#define PACKET_HEIGHT 2
#define BLOCK         BLOCK_SIDE
#define LANE_X        (uint8)(0, 1, 2, 3, 0, 1, 2, 3)
#define LANE_Y        (uint8)(0, 0, 0, 0, 1, 1, 1, 1)
#else
#define PACKET_WIDTH  4
#define PACKET_HEIGHT 4
#define BLOCK         BLOCK_SIDE
#define LANE_X        (uint16)(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3)
#define LANE_Y        (uint16)(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3)
#endif

static inline Real mean_of(ULong sum, ulong count)
{
    return to_real((sum + count / 2) / count) * 0x1p-32f;
}

// Positions in the picture, in pixels or in half sub-pixels.
typedef struct {
    UInt x, y;
    Mask active;
} Places;

// Computes the colors of samples at positions in half sub-pixels. The colors are in steps of 2^-32.
// On CPUs, functions with variables of type Paths are not inlined. Otherwise, PoCL would keep the
// private memory of all work-items of a group on the stack at once.
static NOT_INLINE void sample_colors(const Tracer *tracer, const Places samples[PACKETS],
                                     Real3 colors[PACKETS])
{
    Paths paths;
    for (uint i = 0; i < PACKETS; i++)
        paths_start(
            &paths, i,
            camera_ray_toward(tracer->frame, samples[i].x, samples[i].y, samples[i].active));
    trace(tracer, &paths, colors);
}

// The sums of the samples' colors, in steps of 2^-32. Integer sums are exact, so a constant color
// stays unchanged for any number of samples.
typedef struct {
    ULong red, green, blue;
} ColorSum;

static inline void add_colors(ColorSum *sum, Real3 color)
{
    sum->red += to_long(color.x);
    sum->green += to_long(color.y);
    sum->blue += to_long(color.z);
}

// Computes the mean colors of pixels. A single sample is not summed, because dividing a sum would
// take longer than tracing a simple scene.
static inline void pixel_colors(const Tracer *tracer, const Places pixels[PACKETS],
                                Real3 colors[PACKETS])
{
    ColorSum sums[PACKETS];
    Places samples[PACKETS];
    const uint side = tracer->frame->samples, count = side * side;
    for (uint i = 0; i < PACKETS && count > 1; i++)
        sums[i] = (ColorSum){0, 0, 0};
    for (uint sample = 0; sample < count; sample++) {
        for (uint i = 0; i < PACKETS; i++)
            samples[i] = (Places){2 * (pixels[i].x * side + sample % side) + 1,
                                  2 * (pixels[i].y * side + sample / side) + 1, pixels[i].active};
        sample_colors(tracer, samples, colors);
        for (uint i = 0; i < PACKETS && count > 1; i++)
            add_colors(&sums[i], colors[i]);
    }
    for (uint i = 0; i < PACKETS; i++)
        if (count > 1)
            colors[i] = real3_of(mean_of(sums[i].red, count), mean_of(sums[i].green, count),
                                 mean_of(sums[i].blue, count));
        else
            colors[i] = scaled3(0x1p-32f, colors[i]);
}

// Stores the tally at place `number` of `tallies`.
static inline void store_tally(global uint *tallies, size_t number, const Tally *tally)
{
    global uint *counts = tallies + number * TALLY_STORED;
#if CLRT_STATISTICS
    counts[TALLY_CAMERA_RAYS] = tally->camera_rays;
    counts[TALLY_SHADOW_RAYS] = tally->shadow_rays;
    counts[TALLY_REFLECTED_RAYS] = tally->reflected_rays;
    counts[TALLY_SHADED_POINTS] = tally->shaded_points;
    counts[TALLY_CAMERA_HITS] = tally->camera_hits;
    counts[TALLY_TRIANGLE_TESTS] = tally->triangle_tests;
    counts[TALLY_BOX_TESTS] = tally->box_tests;
    counts[TALLY_SPHERE_TESTS] = tally->sphere_tests;
    counts += TALLY_CUT;
#endif
#if CLRT_GLASS
    counts[0] = (uint)tally->cut;
    counts[1] = (uint)(tally->cut >> 32);
#else
    counts[0] = counts[1] = 0;
#endif
}

static inline void store_lane(global float *pixel, const Real3 *color, uint lane)
{
    pixel[0] = (float)((const Scalar *)&color->x)[lane];
    pixel[1] = (float)((const Scalar *)&color->y)[lane];
    pixel[2] = (float)((const Scalar *)&color->z)[lane];
}

// Returns the pixels of the packet at `corner` of the tile. Pixels outside the tile are inactive.
static inline Places places_at(const FrameData *frame, uint2 corner)
{
    const UInt column = corner.x + LANE_X, row = corner.y + LANE_Y;
    return (Places){frame->tile_x + column, frame->tile_y + row,
                    column < frame->tile_width && row < frame->tile_height};
}
