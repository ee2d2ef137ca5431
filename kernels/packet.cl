// SPDX-License-Identifier: MIT
// Packets of rays whose directions share their signs, and their tests against the triangles of a
// block. Bounds over the rays cull eight triangles at a time. Each remaining triangle is tested
// against all lanes at once with triangle.inc.cl's operations.
#ifndef CLRT_PACKET_CL
#define CLRT_PACKET_CL
#include "wide.cl"

#if CLRT_WIDE_NODES

typedef struct {
    Search rays;   // inactive lanes copy an active one
    bool one_axis; // all rays have the same longest axis
    uint axes[3];  // if one_axis is set, the shear's x, y and z axes
} Packet;

static inline void packet_prepare(Packet *packet, const Tracer *tracer, const Ray *ray, Real limit)
{
    packet->rays = search_along(tracer, ray, limit);
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

// Returns a corner relative to each ray's origin, in the order of each ray's axes.
static inline Real3 corner_from(const BlockPlace *at, uint corner, const Packet *packet)
{
    const Real3 o = packet->rays.origin;
    if (!packet->one_axis)
        return difference(axes_ordered(splat_corner(at, corner), &packet->rays.axes), o);
    return real3_of((Real)(at->block->corners[corner][packet->axes[0]][at->place]) - o.x,
                    (Real)(at->block->corners[corner][packet->axes[1]][at->place]) - o.y,
                    (Real)(at->block->corners[corner][packet->axes[2]][at->place]) - o.z);
}

// Tests a block's triangles against the rays of the lanes whose bits are set. `near` has the bits
// of the triangles that these rays may hit. Returns whether a hit changed.
static ALWAYS_INLINE bool intersect_packet_block(const BlockPlace *start, const Packet *packet,
                                                 uint bits, uint near, Hit *best)
{
    Mask changed = 0;
    const Mask lanes = lanes_of(bits);
    for (; near != 0; near &= near - 1) {
        const uint place = lowest_bit(near);
        const BlockPlace at = {start->block, place, start->index + place};
        const Corners relative = {corner_from(&at, 0, packet), corner_from(&at, 1, packet),
                                  corner_from(&at, 2, packet)};
        const uint id = at.block->id[place];
        const TriangleName name = {id & ~TRIANGLE_MARKS, id & TRIANGLE_MARKS, at.index};
        changed = intersect_triangle(&packet->rays, &name, &relative, lanes, best) || changed;
    }
    return any_lane(changed);
}

#endif
#endif
