// SPDX-License-Identifier: MIT
// The rendering kernel. With binary nodes, a work-item renders one pixel of a tile. With wide
// nodes, it renders a block of BLOCK x BLOCK pixels, PACKETS packets at a time.
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

// The packets of a beam, side by side.
#define BEAM_COLUMNS (PACKETS == 1 ? 1 : 2)
#define BEAM_WIDTH   (PACKET_WIDTH * BEAM_COLUMNS)
#define BEAM_HEIGHT  (PACKET_HEIGHT * (PACKETS / BEAM_COLUMNS))

static inline Real mean_of(ULong sum, ulong count)
{
    return to_real((sum + count / 2) / count) * 0x1p-32f;
}

// Positions in the picture, in pixels or in samples.
typedef struct {
    UInt x, y;
    Mask active;
} Places;

// Computes the colors of samples in steps of 2^-32. Functions with paths are not inlined. Otherwise
// PoCL would keep the private memory of all work-items of a group on its stack at once.
static NOT_INLINE void sample_colors(const Tracer *tracer, const Places samples[PACKETS],
                                     Real3 colors[PACKETS])
{
    Paths paths;
    for (uint i = 0; i < PACKETS; i++)
        paths_start(&paths, i,
                    camera_ray(tracer->frame, samples[i].x, samples[i].y, samples[i].active));
    trace(tracer, &paths, colors);
}

// Sums of samples in steps of 2^-32, which are exact in any order. A constant color therefore stays
// unchanged for any number of samples.
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
            samples[i] = (Places){pixels[i].x * side + sample % side,
                                  pixels[i].y * side + sample / side, pixels[i].active};
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

// Stores the packet if it is entirely inside the tile. Returns whether it is.
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

// Stores the colors of the lanes inside the tile, and the tally at the first lane.
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

// Returns a packet's pixels; pixels outside the tile are inactive.
static inline Places places_at(const FrameData *frame, uint2 corner)
{
    const UInt column = corner.x + LANE_X, row = corner.y + LANE_Y;
    return (Places){frame->tile_x + column, frame->tile_y + row,
                    column < frame->tile_width && row < frame->tile_height};
}

// Returns the top left pixel of a beam's packet.
static inline uint2 packet_corner(uint2 beam, uint packet)
{
    return (uint2)(beam.x + packet % BEAM_COLUMNS * PACKET_WIDTH,
                   beam.y + packet / BEAM_COLUMNS * PACKET_HEIGHT);
}

// Renders the beam whose top left pixel is given.
static NOT_INLINE void render_beam(const Tracer *tracer, uint2 beam, const Output *output)
{
    const Tally none = {0};
    Places places[PACKETS];
    Real3 colors[PACKETS];
    for (uint i = 0; i < PACKETS; i++)
        places[i] = places_at(tracer->frame, packet_corner(beam, i));
    pixel_colors(tracer, places, colors);
    for (uint i = 0; i < PACKETS; i++)
        store_packet(tracer->frame, packet_corner(beam, i), &colors[i],
                     i == 0 ? tracer->tally : &none, output);
}

// Renders a tile. pixels receives tile_width * tile_height colors of three floats, top row first.
// tallies receives TALLY_KINDS counts per pixel, if statistics are compiled in. The range of
// work-items is padded to whole work-groups.
kernel void render_tile(TRACER_ARGUMENTS, global float *pixels, global uint *tallies)
{
    const Output output = {pixels, tallies};
    const uint left = BLOCK * (uint)get_global_id(0), top = BLOCK * (uint)get_global_id(1);
    for (uint y = top; y < min(top + BLOCK, frame.tile_height); y += BEAM_HEIGHT)
        for (uint x = left; x < min(left + BLOCK, frame.tile_width); x += BEAM_WIDTH) {
            Tally tally = {0};
            const Tracer tracer = TRACER(&tally);
            render_beam(&tracer, (uint2)(x, y), &output);
        }
}
