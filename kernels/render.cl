// SPDX-License-Identifier: MIT
// The rendering kernel: a work-item renders one pixel of a tile. In the packet family it renders a
// block of BLOCK x BLOCK pixels, one packet after another.
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
#define BLOCK         PACKET_SIDE
#define LANE_X        (uint4)(0, 1, 0, 1)
#define LANE_Y        (uint4)(0, 0, 1, 1)
#elif CLRT_LANES == 8
#define PACKET_WIDTH  4
#define PACKET_HEIGHT 2
#define BLOCK         PACKET_SIDE
#define LANE_X        (uint8)(0, 1, 2, 3, 0, 1, 2, 3)
#define LANE_Y        (uint8)(0, 0, 0, 0, 1, 1, 1, 1)
#else
#define PACKET_WIDTH  4
#define PACKET_HEIGHT 4
#define BLOCK         PACKET_SIDE
#define LANE_X        (uint16)(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3)
#define LANE_Y        (uint16)(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3)
#endif

// Colors are rounded to integer multiples of 2^-32.
static inline Real in_steps(Real color)
{
    return rint(clamp_to_one(color) * 0x1p32f);
}

static inline Real mean_of(ULong sum, ulong count)
{
    return to_real((sum + count / 2) / count) * 0x1p-32f;
}

// Positions in the picture, in pixels or in samples.
typedef struct {
    UInt x, y;
    Mask active;
} Places;

static inline Real3 sample_color(const Tracer *tracer, const Places *samples)
{
    const Ray ray = camera_ray(tracer->frame, samples->x, samples->y, samples->active);
    const Real3 color = trace(tracer, ray);
    if (CLRT_STATISTICS)
        tracer->tally->camera_rays += lane_count(samples->active);
    return real3_of(in_steps(color.x), in_steps(color.y), in_steps(color.z));
}

// Samples are summed as integers, which is exact in any order. A constant color therefore stays
// unchanged for any number of samples.
static inline Real3 mean_color(const Tracer *tracer, const Places *pixels)
{
    ULong red = 0, green = 0, blue = 0;
    const uint side = tracer->frame->samples;
    for (uint row = 0; row < side; row++)
        for (uint column = 0; column < side; column++) {
            const Places samples = {pixels->x * side + column, pixels->y * side + row,
                                    pixels->active};
            const Real3 color = sample_color(tracer, &samples);
            red += to_long(color.x);
            green += to_long(color.y);
            blue += to_long(color.z);
        }
    const ulong count = (ulong)side * side;
    return real3_of(mean_of(red, count), mean_of(green, count), mean_of(blue, count));
}

// A single sample needs no sum, whose division costs more than tracing a simple scene.
static inline Real3 pixel_color(const Tracer *tracer, const Places *pixels)
{
    if (tracer->frame->samples > 1)
        return mean_color(tracer, pixels);
    return scaled3(0x1p-32f, sample_color(tracer, pixels));
}

static inline void store_tally(global uint *counts, const Tally *tally)
{
    counts[TALLY_CAMERA_RAYS] = tally->camera_rays;
    counts[TALLY_SHADOW_RAYS] = tally->shadow_rays;
    counts[TALLY_REFLECTED_RAYS] = tally->reflected_rays;
    counts[TALLY_SHADED_POINTS] = tally->shaded_points;
    counts[TALLY_CAMERA_HITS] = tally->camera_hits;
    counts[TALLY_TRIANGLE_TESTS] = tally->triangle_tests;
    counts[TALLY_BOX_TESTS] = tally->box_tests;
    counts[TALLY_SPHERE_TESTS] = tally->sphere_tests;
}

typedef struct {
    global float *pixels;
    global uint *tallies;
} Output;

#if PACKET_WIDTH == 4
// Stores four adjacent pixels.
static inline void store_row(global float *pixels, float4 red, float4 green, float4 blue)
{
    vstore4((float4)(red.x, green.x, blue.x, red.y), 0, pixels);
    vstore4((float4)(green.y, blue.y, red.z, green.z), 1, pixels);
    vstore4((float4)(blue.z, red.w, green.w, blue.w), 2, pixels);
}

// Stores the packet if it lies entirely inside the tile, and returns whether it does.
static inline bool store_rows(const FrameData *frame, uint2 corner, const Real3 *color,
                              global float *pixels)
{
    const float4 *red = (const float4 *)&color->x, *green = (const float4 *)&color->y,
                 *blue = (const float4 *)&color->z;
    if (corner.x + PACKET_WIDTH > frame->tile_width ||
        corner.y + PACKET_HEIGHT > frame->tile_height)
        return false;
    for (uint row = 0; row < PACKET_HEIGHT; row++) {
        const size_t place = (size_t)(corner.y + row) * frame->tile_width + corner.x;
        store_row(pixels + 3 * place, red[row], green[row], blue[row]);
    }
    return true;
}
#else
static inline bool store_rows(const FrameData *frame, uint2 corner, const Real3 *color,
                              global float *pixels)
{
    (void)frame, (void)corner, (void)color, (void)pixels;
    return false;
}
#endif

static inline void store_lane(global float *pixel, const Real3 *color, uint lane)
{
    pixel[0] = (float)((const Scalar *)&color->x)[lane];
    pixel[1] = (float)((const Scalar *)&color->y)[lane];
    pixel[2] = (float)((const Scalar *)&color->z)[lane];
}

// Stores the colors of the lanes inside the tile, and the cost of all lanes at the first of them.
static inline void store_packet(const FrameData *frame, uint2 corner, const Real3 *color,
                                const Tally *tally, const Output *output)
{
    const Tally none = {0};
    if (!CLRT_STATISTICS && store_rows(frame, corner, color, output->pixels))
        return;
    for (uint lane = 0; lane < CLRT_LANES; lane++) {
        const uint column = corner.x + lane % PACKET_WIDTH, row = corner.y + lane / PACKET_WIDTH;
        if (column >= frame->tile_width || row >= frame->tile_height)
            continue;
        const size_t place = (size_t)row * frame->tile_width + column;
        store_lane(output->pixels + 3 * place, color, lane);
        if (CLRT_STATISTICS)
            store_tally(output->tallies + place * TALLY_KINDS, lane == 0 ? tally : &none);
    }
}

// pixels holds tile_width * tile_height colors of three floats, rows from the top. tallies holds
// TALLY_KINDS counts per pixel, written only if statistics are compiled in. The range is padded to
// whole work-groups.
kernel void render_tile(TRACER_ARGUMENTS, global float *pixels, global uint *tallies)
{
    const Output output = {pixels, tallies};
    const uint left = BLOCK * (uint)get_global_id(0), top = BLOCK * (uint)get_global_id(1);
    for (uint y = top; y < min(top + BLOCK, frame.tile_height); y += PACKET_HEIGHT)
        for (uint x = left; x < min(left + BLOCK, frame.tile_width); x += PACKET_WIDTH) {
            const UInt column = x + LANE_X, row = y + LANE_Y;
            const Places places = {frame.tile_x + column, frame.tile_y + row,
                                   column < frame.tile_width && row < frame.tile_height};
            Tally tally = {0};
            const Tracer tracer = TRACER(&tally);
            const Real3 color = pixel_color(&tracer, &places);
            store_packet(&frame, (uint2)(x, y), &color, &tally, &output);
        }
}
