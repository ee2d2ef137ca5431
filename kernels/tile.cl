// SPDX-License-Identifier: MIT
// The kernel that renders pictures, tile by tile. It is compiled after render.cl, and only if
// requested.
#include "pixels.cl"

typedef struct {
    global float *pixels;
    global uint *tallies;
} Output;

// Stores the colors of the lanes inside the tile. With CLRT_TALLIES, stores the tally at the first
// lane, and zeros at the other lanes.
static inline void store_packet(const FrameData *frame, uint2 corner, const Real3 *color,
                                const Tally *tally, const Output *output)
{
    const Tally none = {0};
    store_colors(frame, corner, color, output->pixels);
    for (uint lane = 0; CLRT_TALLIES && lane < CLRT_LANES; lane++)
        if (is_in_tile(frame, corner, lane))
            store_tally(output->tallies, pixel_index(frame, corner, lane),
                        lane == 0 ? tally : &none);
}

static NOT_INLINE void render_sky(const FrameData *frame, uint2 beam, const Output *output)
{
    const Tally none = {0};
    const Real3 color = sky_color(frame);
    for (uint i = 0; i < PACKETS; i++)
        store_packet(frame, packet_corner(beam, i), &color, &none, output);
}

// Renders the beam with the top left pixel `beam`.
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
// With CLRT_TALLIES, `tallies` receives TALLY_STORED counts per pixel. The range of work-items is
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
