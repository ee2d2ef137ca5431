// SPDX-License-Identifier: MIT
// The kernel that renders pictures, tile by tile. It is compiled after render.cl, and only if
// requested.
#include "sky.cl"

// The columns of packets in a beam, and the beam's size in pixels.
#define BEAM_COLUMNS (PACKETS == 1 ? 1 : 2)
#define BEAM_WIDTH   (PACKET_WIDTH * BEAM_COLUMNS)
#define BEAM_HEIGHT  (PACKET_HEIGHT * (PACKETS / BEAM_COLUMNS))

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

// If the packet is entirely inside the tile, stores it and returns true.
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

// Stores the colors of the lanes inside the tile. With CLRT_TALLIES, stores the tally at the first
// lane.
static inline void store_packet(const FrameData *frame, uint2 corner, const Real3 *color,
                                const Tally *tally, const Output *output)
{
    const Tally none = {0};
    if (!CLRT_TALLIES && store_rows(frame, corner, color, output->pixels))
        return;
    for (uint lane = 0; lane < CLRT_LANES; lane++) {
        const uint column = corner.x + lane % PACKET_WIDTH, row = corner.y + lane / PACKET_WIDTH;
        if (column >= frame->tile_width || row >= frame->tile_height)
            continue;
        const size_t place = (size_t)row * frame->tile_width + column;
        store_lane(output->pixels + 3 * place, color, lane);
        if (CLRT_TALLIES)
            store_tally(output->tallies + place * TALLY_KINDS, lane == 0 ? tally : &none);
    }
}

// Returns the top left pixel of a beam's packet.
static inline uint2 packet_corner(uint2 beam, uint packet)
{
    return (uint2)(beam.x + packet % BEAM_COLUMNS * PACKET_WIDTH,
                   beam.y + packet / BEAM_COLUMNS * PACKET_HEIGHT);
}

static NOT_INLINE void render_sky(const FrameData *frame, uint2 beam, const Output *output)
{
    const Tally none = {0};
    const Real3 color = scaled3(0x1p-32f, in_steps3(load_private3(frame->background)));
    for (uint i = 0; i < PACKETS; i++)
        store_packet(frame, packet_corner(beam, i), &color, &none, output);
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

// Renders a tile. `pixels` receives tile_width * tile_height colors of three floats, top row first.
// With CLRT_TALLIES, `tallies` receives TALLY_KINDS counts per pixel. The range of work-items is
// padded to whole work-groups.
kernel void render_tile(TRACER_ARGUMENTS, global float *pixels, global uint *tallies)
{
    const Output output = {pixels, tallies};
    const uint left = BLOCK * (uint)get_global_id(0), top = BLOCK * (uint)get_global_id(1);
    const bool has_hits = BLOCK == 1 || CLRT_STATISTICS || !is_sky(&frame, left, top);
    for (uint y = top; y < min(top + BLOCK, frame.tile_height); y += BEAM_HEIGHT)
        for (uint x = left; x < min(left + BLOCK, frame.tile_width); x += BEAM_WIDTH) {
            Tally tally = {0};
            const Tracer tracer = TRACER(&tally);
            if (has_hits)
                render_beam(&tracer, (uint2)(x, y), &output);
            else
                render_sky(&frame, (uint2)(x, y), &output);
        }
}
