// SPDX-License-Identifier: MIT
// Places a tile's packets, and stores the colors of their pixels.
#include "sky.cl"

// The number of columns of packets in a beam, and the beam's size in pixels.
#define BEAM_COLUMNS (PACKETS == 1 ? 1 : 2)
#define BEAM_WIDTH   (PACKET_WIDTH * BEAM_COLUMNS)
#define BEAM_HEIGHT  (PACKET_HEIGHT * (PACKETS / BEAM_COLUMNS))

// Returns the top left pixel of a beam's packet.
static inline uint2 packet_corner(uint2 beam, uint packet)
{
    return (uint2)(beam.x + packet % BEAM_COLUMNS * PACKET_WIDTH,
                   beam.y + packet / BEAM_COLUMNS * PACKET_HEIGHT);
}

#if PACKET_WIDTH == 4
// Stores four adjacent pixels.
static inline void store_row(global float *pixels, float4 red, float4 green, float4 blue)
{
    vstore4((float4)(red.x, green.x, blue.x, red.y), 0, pixels);
    vstore4((float4)(green.y, blue.y, red.z, green.z), 1, pixels);
    vstore4((float4)(blue.z, red.w, green.w, blue.w), 2, pixels);
}

// If the packet is entirely inside the tile, stores the packet's colors and returns true.
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

// Returns whether a lane's pixel is inside the tile.
static inline bool is_in_tile(const FrameData *frame, uint2 corner, uint lane)
{
    return corner.x + lane % PACKET_WIDTH < frame->tile_width &&
           corner.y + lane / PACKET_WIDTH < frame->tile_height;
}

// Returns the index of a lane's pixel in the tile.
static inline size_t pixel_index(const FrameData *frame, uint2 corner, uint lane)
{
    return (size_t)(corner.y + lane / PACKET_WIDTH) * frame->tile_width + corner.x +
           lane % PACKET_WIDTH;
}

// Stores the colors of the lanes inside the tile.
static inline void store_colors(const FrameData *frame, uint2 corner, const Real3 *color,
                                global float *pixels)
{
    if (store_rows(frame, corner, color, pixels))
        return;
    for (uint lane = 0; lane < CLRT_LANES; lane++)
        if (is_in_tile(frame, corner, lane))
            store_lane(pixels + 3 * pixel_index(frame, corner, lane), color, lane);
}
