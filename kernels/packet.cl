// SPDX-License-Identifier: MIT
// Tests packets of rays against the triangles of a block. All rays of a packet point into the same
// octant. Bounds over the rays have already culled most of the block's triangles (bounds.cl). Each
// remaining triangle is tested against all lanes at once, by the operations of triangle.inc.cl.
#ifndef CLRT_PACKET_CL
#define CLRT_PACKET_CL
#include "wide.cl"

#if CLRT_WIDE_NODES

typedef struct {
    Search rays;   // inactive lanes have copies of an active ray
    bool one_axis; // all rays have the same longest axis
    uint axes[3];  // if one_axis is set, the shear's x, y and z axes
} Packet;

// Prepares the tests against triangles, which many packets never need.
static inline void packet_shear(Packet *packet)
{
    search_shear(&packet->rays);
    const ShearAxes axes = packet->rays.axes;
    packet->axes[0] = lane_uint(&axes.x, 0);
    packet->axes[1] = lane_uint(&axes.y, 0);
    packet->axes[2] = lane_uint(&axes.z, 0);
    packet->one_axis = !any_lane(axes.z != (UInt)(packet->axes[2]));
}

static inline Real3 splat_corner(const BlockPlace *at, uint corner)
{
    return real3_of(at->block->corners[corner][0][at->place],
                    at->block->corners[corner][1][at->place],
                    at->block->corners[corner][2][at->place]);
}

// Three rows of a block: each has one coordinate of the triangles' first corners. The rows are in
// the order of a packet's axes. The rows of each further corner start 3 * WIDE floats later.
typedef struct {
    global const float *x, *y, *z;
} BlockRows;

static inline BlockRows rows_ordered(global const TriangleBlock *block, const Packet *packet)
{
    global const float *rows = block->corners[0][0];
    return (BlockRows){rows + packet->axes[0] * WIDE, rows + packet->axes[1] * WIDE,
                       rows + packet->axes[2] * WIDE};
}

// Returns a corner relative to each ray's origin. All rays must have the same axes.
static inline Real3 corner_in_rows(const BlockRows *rows, uint word, Real3 backward)
{
    return real3_of(rows->x[word] + backward.x, rows->y[word] + backward.y,
                    rows->z[word] + backward.z);
}

// Returns a corner relative to each ray's origin, with its coordinates in the order of the ray's
// axes.
static inline Real3 corner_from(const BlockPlace *at, uint corner, const Packet *packet)
{
    return sum3(axes_ordered(splat_corner(at, corner), &packet->rays.axes), packet->rays.backward);
}

static ALWAYS_INLINE Corners corners_from(const BlockPlace *at, const BlockRows *rows,
                                          const Packet *packet, bool one_axis)
{
    const Real3 backward = packet->rays.backward;
    if (one_axis)
        return (Corners){corner_in_rows(rows, at->place, backward),
                         corner_in_rows(rows, at->place + 3 * WIDE, backward),
                         corner_in_rows(rows, at->place + 6 * WIDE, backward)};
    return (Corners){corner_from(at, 0, packet), corner_from(at, 1, packet),
                     corner_from(at, 2, packet)};
}

// Returns the bits of the triangles in `near` that may be hit by the line of at least one ray in
// `lanes`, other than the ray's own triangle. All rays must have the same axes. The loop has no
// branches. It does not compute determinants, because intersect_triangle tests them later. With
// AVX2, this saves 1 % of the time of a gear with 100 thousand triangles.
static ALWAYS_INLINE uint triangles_entered(const BlockPlace *start, const BlockRows *rows,
                                            const Packet *packet, Mask lanes, uint near)
{
    const UInt own = packet->rays.ray->own_index - start->index; // slot of the ray's own triangle
    uint entered = 0;
    for (; near != 0; near &= near - 1) {
        const BlockPlace at = {start->block, lowest_bit(near), 0};
        const Corners relative = corners_from(&at, rows, packet, true);
        const Corners sheared = corners_sheared(&relative, &packet->rays.shear);
        const Edges edges = edges_of(&sheared);
        const uint inside = lane_bits(lanes && edges_agree(&edges) && own != at.place);
        entered |= inside != 0 ? near & -near : 0;
    }
    return entered;
}

// Tests a block's triangles against the rays of the lanes whose bits are set. `near` has the bits
// of the triangles that these rays may hit. Returns whether a hit changed.
static ALWAYS_INLINE bool intersect_packet_block(const BlockPlace *start, const Packet *packet,
                                                 uint bits, uint near, Hit *best)
{
    Mask changed = 0;
    const Mask lanes = lanes_of(bits);
    const BlockRows rows = rows_ordered(start->block, packet);
    const bool one_axis = packet->one_axis;
    if (one_axis && plain_kind(packet->rays.ray->kind) != RAY_CAMERA)
        near = triangles_entered(start, &rows, packet, lanes, near);
    for (; near != 0; near &= near - 1) {
        const uint place = lowest_bit(near);
        const BlockPlace at = {start->block, place, start->index + place};
        const Corners relative = corners_from(&at, &rows, packet, one_axis);
        const uint id = at.block->id[place];
        const TriangleName name = {id & ~TRIANGLE_MARKS, id & TRIANGLE_MARKS, at.index};
        changed = intersect_triangle(&packet->rays, &name, &relative, lanes, best) || changed;
    }
    return any_lane(changed);
}

#endif
#endif
