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

// The result of testing a packet against a triangle. `inside` selects the rays that pass inside its
// edges.
typedef struct {
    Corners sheared;
    Edges edges;
    Mask inside;
} PacketTest;

// Returns which rays stop on a triangle that they hit within rounding of their start.
static NOT_INLINE Mask packet_neighbors(const Corners *corners, const Packet *packet, uint index,
                                        Mask from_back)
{
    const Ray *ray = packet->rays.ray;
    const Mask known = ray->own_index != NOTHING;
    const Corners own = fetch_corners(packet->rays.tracer, known ? ray->own_index : (UInt)(0));
    Mask cross;
    const Mask stops = hits_neighbor(&own, corners, ray->direction, from_back, &cross);
    if (!any_lane(known && cross))
        return known && stops;
    return known && (stops || (cross && is_ahead(packet->rays.tracer, ray, (UInt)(index))));
}

// Returns the distances of the rays that stop on the triangle, INFINITY for the others. Distances
// of camera rays may be beyond `reach`.
static inline Real packet_distances(const BlockPlace *at, const Packet *packet,
                                    const PacketTest *test, Real reach)
{
    const Ray *ray = packet->rays.ray;
    const Shear *shear = &packet->rays.shear;
    const uint id = at->block->id[at->place];
    const Mask front = edges_face(&test->edges, shear);
    const Mask inner = (id & TRIANGLE_REVERSED) != 0 ? front : !front;
    const Mask closed = (id & TRIANGLE_TWO_SIDED) != 0 ? test->inside : test->inside && !inner;
    const Real t = triangle_depth(&test->sheared, &test->edges) * shear->inverse_z;
    const Real clear = closed && t > 0.0f ? t : INFINITY;
    Mask near = closed && t <= reach;
    if (ray->kind == RAY_CAMERA)
        near = near && triangle_is_at_origin(t, shear);
    else
        near = near && (t > 0.0f || triangle_is_at_origin(t, shear));
    if (!any_lane(near))
        return ray->kind == RAY_CAMERA ? clear : INFINITY;
    const Real error = triangle_depth_error(&test->sheared) * fabs(shear->inverse_z);
    const Corners corners = {splat_corner(at, 0), splat_corner(at, 1), splat_corner(at, 2)};
    const SurfaceRay surface = {ray->origin,        front,       inner, packet->rays.behind,
                                length_of_ray(ray), blur_of(ray)};
    Mask in_doubt;
    const Real distance = surface_ray_distance(&corners, &surface, t, error, &in_doubt);
    if (ray->kind == RAY_CAMERA)
        return near ? distance : clear;
    in_doubt = in_doubt && near;
    if (!any_lane(in_doubt))
        return near ? distance : INFINITY;
    const Mask stops = packet_neighbors(&corners, packet, at->index, !front);
    return near ? (in_doubt && stops ? max(t, (Real)(0.0f)) : distance) : INFINITY;
}

// Tests a triangle against the rays in `lanes`. Returns whether a hit changed.
static ALWAYS_INLINE bool intersect_packet_triangle(const BlockPlace *at, const Packet *packet,
                                                    Mask lanes, Hit *best)
{
    const Corners relative = {corner_from(at, 0, packet), corner_from(at, 1, packet),
                              corner_from(at, 2, packet)};
    PacketTest test;
    test.sheared = corners_sheared(&relative, &packet->rays.shear);
    test.edges = edges_of(&test.sheared);
    test.inside = lanes && edges_contain(&test.edges);
    if (!any_lane(test.inside))
        return false;
    const UInt id = at->block->id[at->place] & ~TRIANGLE_MARKS;
    test.inside = test.inside && packet->rays.ray->own != id;
    if (!any_lane(test.inside))
        return false;
    const Real t = packet_distances(at, packet, &test, search_reach(&packet->rays, best));
    Mask precedes = hit_precedes(t, id, best);
    const Mask close = is_close(&packet->rays, t, best);
    if (any_lane(close)) {
        const Mask nearer = triangle_is_nearer(&packet->rays, id, (UInt)(at->index), best, close);
        precedes = close ? nearer : precedes;
    }
    best->t = precedes ? t : best->t;
    best->id = precedes ? id : best->id;
    best->index = precedes ? (UInt)(at->index) : best->index;
    return any_lane(precedes);
}

// Tests a block's triangles against the rays of the lanes whose bits are set. `near` has the bits
// of the triangles that these rays may hit. Returns whether a hit changed.
static ALWAYS_INLINE bool intersect_packet_block(const BlockPlace *start, const Packet *packet,
                                                 uint bits, uint near, Hit *best)
{
    bool changed = false;
    const Mask lanes = lanes_of(bits);
    for (; near != 0; near &= near - 1) {
        const uint place = lowest_bit(near);
        const BlockPlace at = {start->block, place, start->index + place};
        changed |= intersect_packet_triangle(&at, packet, lanes, best);
    }
    return changed;
}

#endif
#endif
