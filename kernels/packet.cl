// SPDX-License-Identifier: MIT
// Packets of rays that share their signs and longest axis, with bounds over all rays, and their
// test against a block of triangles. The bounds cull eight triangles at a time. Each remaining
// triangle is tested against all lanes at once with triangle.inc.cl's operations.
#ifndef CLRT_PACKET_CL
#define CLRT_PACKET_CL
#include "wide.cl"

#if CLRT_WIDE_NODES

// In a block entered by this many lanes or fewer, each lane is tested alone against all triangles.
#define MOST_LANES_ALONE 2

// Rays that share their signs and longest axis, with bounds over all of them.
typedef struct {
    Search rays; // inactive lanes copy an active one
    Mask active;
    uint axes[3];
    uint negative[3]; // which plane of an axis the rays enter by
    // Bounds over all lanes: distance to a plane = fma(plane, inverse_low, near_low) ...
    float inverse_low[3], inverse_high[3];
    float near_low[3], near_high[3], far_low[3], far_high[3];
    bool common_origin;
} Packet;

static inline float lowest(Real v)
{
#if CLRT_LANES == 16
    const float8 a = min(v.lo, v.hi);
    const float4 b = min(a.lo, a.hi);
#elif CLRT_LANES == 8
    const float4 b = min(v.lo, v.hi);
#else
    const float4 b = v;
#endif
    const float2 c = min(b.lo, b.hi);
    return min(c.x, c.y);
}

static inline float highest(Real v)
{
#if CLRT_LANES == 16
    const float8 a = max(v.lo, v.hi);
    const float4 b = max(a.lo, a.hi);
#elif CLRT_LANES == 8
    const float4 b = max(v.lo, v.hi);
#else
    const float4 b = v;
#endif
    const float2 c = max(b.lo, b.hi);
    return max(c.x, c.y);
}

// The origin farthest forward gives the earliest entry, the one farthest back the latest exit.
static inline void packet_bounds(Packet *packet, uint axis, Real origin, Real slack, Real inverse)
{
    const float low = lowest(inverse), high = highest(inverse);
    const bool negative = high < 0.0f;
    const Real ahead = origin + slack, behind = origin - slack;
    const float most = packet->common_origin ? ahead.s0 : highest(ahead);
    const float least = packet->common_origin ? behind.s0 : lowest(behind);
    const float near = negative ? least : most, far = negative ? most : least;
    packet->negative[axis] = negative;
    packet->inverse_low[axis] = low;
    packet->inverse_high[axis] = high;
    packet->near_low[axis] = -near * low;
    packet->near_high[axis] = -near * high;
    packet->far_low[axis] = -far * low;
    packet->far_high[axis] = -far * high;
}

// Returns component `axis` of all lanes.
static inline Real on_axis(const Real3 *v, uint axis)
{
    return (&v->x)[axis];
}

// Prepares rays with origins o and directions d, longest along the axis z. On that axis the slabs
// use the shear's inverse unchanged, because no other component is as long.
static inline void packet_prepare(Packet *packet, Real3 o, Real3 d, uint z)
{
    Search *rays = &packet->rays;
    const uint x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
    rays->slabs = slabs_of(o, d);
    rays->axes = (ShearAxes){x, y, z};
    rays->shear.direction_z = on_axis(&d, z);
    rays->shear.inverse_z = on_axis(&rays->slabs.inverse, z);
    rays->shear.shear_x = on_axis(&d, x) * rays->shear.inverse_z;
    rays->shear.shear_y = on_axis(&d, y) * rays->shear.inverse_z;
    packet->rays.origin = real3_of(on_axis(&o, x), on_axis(&o, y), on_axis(&o, z));
    packet->axes[0] = x;
    packet->axes[1] = y;
    packet->axes[2] = z;
    // The origin's own slack, plus the slack that nodes have and boxes of single triangles lack.
    // Triangle coordinates are at most 1.
    const Real slack = BVH_SLACK * (largest_component(o) + 1.0f);
    packet_bounds(packet, 0, o.x, slack, rays->slabs.inverse.x);
    packet_bounds(packet, 1, o.y, slack, rays->slabs.inverse.y);
    packet_bounds(packet, 2, o.z, slack, rays->slabs.inverse.z);
}

static inline Real one_lane(Real v, uint lane)
{
    return (Real)(lane_real(&v, lane));
}

static inline Real3 filled(Real3 v, Mask lanes, uint lane)
{
    return real3_of(lanes ? v.x : one_lane(v.x, lane), lanes ? v.y : one_lane(v.y, lane),
                    lanes ? v.z : one_lane(v.z, lane));
}

// Gathers the lanes whose bits are set into a packet. They share signs and longest axis.
static inline void packet_gather(Packet *packet, const Tracer *tracer, const Ray *ray, uint bits,
                                 uint longest_axis)
{
    const uint first = lowest_bit(bits);
    packet->active = lanes_of(bits);
    packet->common_origin = ray->kind == RAY_CAMERA;
    packet->rays.tracer = tracer;
    packet->rays.ray = ray;
    const Real3 direction = filled(ray->direction, packet->active, first);
    const Real3 origin =
        packet->common_origin ? ray->origin : filled(ray->origin, packet->active, first);
    packet_prepare(packet, origin, direction, longest_axis);
}

// Bounds the distances at which the rays cross an axis's planes.
static inline float8 entry_bound(float8 plane, const Packet *packet, uint axis)
{
    const float8 low =
        fma(plane, (float8)(packet->inverse_low[axis]), (float8)(packet->near_low[axis]));
    const float8 high =
        fma(plane, (float8)(packet->inverse_high[axis]), (float8)(packet->near_high[axis]));
    return min(low, high);
}

static inline float8 leave_bound(float8 plane, const Packet *packet, uint axis)
{
    const float8 low =
        fma(plane, (float8)(packet->inverse_low[axis]), (float8)(packet->far_low[axis]));
    const float8 high =
        fma(plane, (float8)(packet->inverse_high[axis]), (float8)(packet->far_high[axis]));
    return max(low, high);
}

// Returns the planes of the triangles' boxes that the rays enter by, or the opposite ones.
static inline float8 block_plane(global const TriangleBlock *block, const Packet *packet, uint axis,
                                 uint other)
{
    const float8 a = block_row(block, 0, axis), b = block_row(block, 1, axis);
    const float8 c = block_row(block, 2, axis);
    return (packet->negative[axis] ^ other) ? max(max(a, b), c) : min(min(a, b), c);
}

// Returns the triangles that some ray of the packet may hit before `reach`: a third of a block's.
// Testing one triangle against all lanes costs as much as this call.
static inline uint triangles_near(global const TriangleBlock *block, const Packet *packet,
                                  float reach)
{
    const float8 near_x = entry_bound(block_plane(block, packet, 0, 0), packet, 0);
    const float8 near_y = entry_bound(block_plane(block, packet, 1, 0), packet, 1);
    const float8 near_z = entry_bound(block_plane(block, packet, 2, 0), packet, 2);
    const float8 far_x = leave_bound(block_plane(block, packet, 0, 1), packet, 0);
    const float8 far_y = leave_bound(block_plane(block, packet, 1, 1), packet, 1);
    const float8 far_z = leave_bound(block_plane(block, packet, 2, 1), packet, 2);
    const float8 entry = max(max(near_x, near_y), max(near_z, (float8)(0.0f)));
    return lane_bits(entry <= min(min(far_x, far_y), min(far_z, (float8)(reach))));
}

static inline Real3 splat_corner(const BlockPlace *at, uint corner)
{
    return real3_of(at->block->corners[corner][0][at->place],
                    at->block->corners[corner][1][at->place],
                    at->block->corners[corner][2][at->place]);
}

// The result of testing a packet against a triangle: the lanes whose rays pass inside its edges.
typedef struct {
    Corners sheared;
    Edges edges;
    Mask inside;
} PacketTest;

// Returns which rays stop on a triangle that their lines hit within rounding of the ray's own.
static NOT_INLINE Mask packet_neighbors(const Corners *corners, const Packet *packet,
                                        Mask from_back)
{
    const Ray *ray = packet->rays.ray;
    const Mask known = ray->own_index != NOTHING;
    const Corners own = fetch_corners(packet->rays.tracer, known ? ray->own_index : (UInt)(0));
    return known && hits_neighbor(&own, corners, ray->direction, from_back);
}

// Returns the distances of those hits, INFINITY for rays that do not stop before `reach`.
static inline Real packet_distances(const BlockPlace *at, const Packet *packet,
                                    const PacketTest *test, Real reach)
{
    const Ray *ray = packet->rays.ray;
    const Shear *shear = &packet->rays.shear;
    const uint id = at->block->id[at->place];
    const Mask front = edges_face(&test->edges, shear);
    const Mask inner = (id & TRIANGLE_REVERSED) != 0 ? front : !front;
    Mask closed = test->inside && ray->own != (UInt)(id & ~TRIANGLE_MARKS);
    if ((id & TRIANGLE_TWO_SIDED) == 0)
        closed = closed && !inner;
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
    const SurfaceRay surface = {ray->origin, front, inner, length_of_ray(ray), blur_of(ray)};
    Mask in_doubt;
    const Real distance = surface_ray_distance(&corners, &surface, t, error, &in_doubt);
    if (ray->kind == RAY_CAMERA)
        return near ? distance : clear;
    in_doubt = in_doubt && near;
    if (!any_lane(in_doubt))
        return near ? distance : INFINITY;
    const Mask stops = packet_neighbors(&corners, packet, !front);
    return near ? (in_doubt && stops ? max(t, (Real)(0.0f)) : distance) : INFINITY;
}

// Corners of a block's triangles relative to the rays' common origin: [corner][axis].
typedef struct {
    float rows[3][3][WIDE];
} RelativeBlock;

static inline void relative_row(RelativeBlock *relative, global const TriangleBlock *block,
                                uint corner, uint axis, const Packet *packet)
{
    const float origin = on_axis(&packet->rays.origin, axis).s0;
    vstore8(vload8(0, block->corners[corner][packet->axes[axis]]) - origin, 0,
            relative->rows[corner][axis]);
}

static inline RelativeBlock relative_block(global const TriangleBlock *block, const Packet *packet)
{
    RelativeBlock relative;
    for (uint corner = 0; corner < 3; corner++)
        for (uint axis = 0; axis < 3; axis++)
            relative_row(&relative, block, corner, axis, packet);
    return relative;
}

static inline Real3 relative_corner(const RelativeBlock *relative, uint corner, uint place)
{
    return real3_of(relative->rows[corner][0][place], relative->rows[corner][1][place],
                    relative->rows[corner][2][place]);
}

// Returns a corner relative to each ray's own origin.
static inline Real3 corner_from(const BlockPlace *at, uint corner, const Packet *packet)
{
    const Real3 o = packet->rays.origin;
    return real3_of((Real)(at->block->corners[corner][packet->axes[0]][at->place]) - o.x,
                    (Real)(at->block->corners[corner][packet->axes[1]][at->place]) - o.y,
                    (Real)(at->block->corners[corner][packet->axes[2]][at->place]) - o.z);
}

static ALWAYS_INLINE bool intersect_packet_triangle(const BlockPlace *at, const Packet *packet,
                                                    const Corners *relative, Mask lanes, Hit *best)
{
    PacketTest test;
    test.sheared = corners_sheared(relative, &packet->rays.shear);
    test.edges = edges_of(&test.sheared);
    test.inside = lanes && edges_contain(&test.edges);
    if (!any_lane(test.inside))
        return false;
    const Real t = packet_distances(at, packet, &test, best->t);
    const UInt id = at->block->id[at->place] & ~TRIANGLE_MARKS;
    const Mask precedes = hit_precedes(t, id, best);
    best->t = precedes ? t : best->t;
    best->id = precedes ? id : best->id;
    best->index = precedes ? (UInt)(at->index) : best->index;
    return any_lane(precedes);
}

static inline BlockPlace place_of(const BlockPlace *start, uint place)
{
    return (BlockPlace){start->block, place, start->index + place};
}

// Tests a block's triangles against the packet's rays in `lanes`, whose hits all lie within
// `reach`. Returns whether a hit changed.
static ALWAYS_INLINE bool intersect_packet_block(const BlockPlace *start, const Packet *packet,
                                                 Mask lanes, float reach, Hit *best)
{
    uint near = triangles_near(start->block, packet, reach);
    bool changed = false;
    if (near == 0)
        return false;
    if (packet->common_origin) {
        const RelativeBlock relative = relative_block(start->block, packet);
        for (; near != 0; near &= near - 1) {
            const BlockPlace at = place_of(start, lowest_bit(near));
            const Corners corners = {relative_corner(&relative, 0, at.place),
                                     relative_corner(&relative, 1, at.place),
                                     relative_corner(&relative, 2, at.place)};
            changed |= intersect_packet_triangle(&at, packet, &corners, lanes, best);
        }
        return changed;
    }
    for (; near != 0; near &= near - 1) {
        const BlockPlace at = place_of(start, lowest_bit(near));
        const Corners corners = {corner_from(&at, 0, packet), corner_from(&at, 1, packet),
                                 corner_from(&at, 2, packet)};
        changed |= intersect_packet_triangle(&at, packet, &corners, lanes, best);
    }
    return changed;
}

// Like intersect_packet_block, for lanes given as bits. If they are few, each is tested alone.
static ALWAYS_INLINE bool intersect_packet_leaf(const BlockPlace *start, const Packet *packet,
                                                uint bits, float reach, Hit *best)
{
    if (popcount(bits) > MOST_LANES_ALONE)
        return intersect_packet_block(start, packet, lanes_of(bits), reach, best);
    bool changed = false;
    for (; bits != 0; bits &= bits - 1)
        changed |= intersect_block(start, &packet->rays, lowest_bit(bits), best);
    return changed;
}

#endif
#endif
