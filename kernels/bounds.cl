// SPDX-License-Identifier: MIT
// Computes bounds over rays whose directions share their signs, by interval arithmetic (Boulos,
// Wald and Shirley, "Geometric and arithmetic culling methods for entire ray packets", 2006). The
// bounds cull eight boxes at a time: a node's children, or the boxes around a block's triangles.
//
// Invariant: the bounds only cull. A box that any of the rays may enter before `reach` is never
// culled.
#ifndef CLRT_BOUNDS_CL
#define CLRT_BOUNDS_CL
#include "packet.cl"

#if CLRT_WIDE_NODES

// All rays cross a near plane of a box at or after the smaller of fma(plane, inverse_low, near_low)
// and fma(plane, inverse_high, near_high). They cross a far plane at or before the larger of
// fma(plane, inverse_low, far_low) and fma(plane, inverse_high, far_high). Each array has one
// element per axis and an unused element.
typedef struct {
    uint negative[4]; // 1 if the rays enter by the higher plane, else 0
    float inverse_low[4], inverse_high[4];
    float near_low[4], near_high[4], far_low[4], far_high[4];
} BeamBounds;

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
    return -lowest(-v);
}

#if CLRT_LANES == 4
static inline float8 folded(Real v)
{
    return (float8)(v.x, v.y, v.z, v.w, v.x, v.y, v.z, v.w);
}
#elif CLRT_LANES == 8
static inline float8 folded(Real v)
{
    return v;
}
#else
static inline float8 folded(Real v)
{
    return min(v.lo, v.hi);
}
#endif

// Returns min(a[i], a[i + 4]) for i from 0 to 3, followed by min(b[i], b[i + 4]).
static inline float8 lowest_of_two(float8 a, float8 b)
{
    const float8 low = (float8)(a.s0, a.s1, a.s2, a.s3, b.s0, b.s1, b.s2, b.s3);
    const float8 high = (float8)(a.s4, a.s5, a.s6, a.s7, b.s4, b.s5, b.s6, b.s7);
    return min(low, high);
}

// Returns the lowest element of each vector. Reducing the four vectors together takes half as many
// instructions as reducing them one after the other.
static inline float4 lowest_of_four(Real a, Real b, Real c, Real d)
{
    const float8 ab = lowest_of_two(folded(a), folded(b)), cd = lowest_of_two(folded(c), folded(d));
    const float8 first = (float8)(ab.s0, ab.s1, ab.s4, ab.s5, cd.s0, cd.s1, cd.s4, cd.s5);
    const float8 second = (float8)(ab.s2, ab.s3, ab.s6, ab.s7, cd.s2, cd.s3, cd.s6, cd.s7);
    const float8 pairs = min(first, second);
    return min(pairs.even, pairs.odd);
}

static inline Real3 lower3(Real3 a, Real3 b)
{
    return real3_of(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z));
}

// The extremes of the packets' rays, separately for each lane. Maxima are stored as minima of the
// negated numbers. Each origin moves by its own slack and by the growth of a node's box, because
// the boxes around a block's triangles have not grown.
typedef struct {
    Real3 inverse, minus_inverse, behind, minus_ahead;
    Real minus_reach;
} Extremes;

static inline void include_rays(Extremes *extremes, const Search *rays, Real reach)
{
    const Real3 inverse = rays->slabs.inverse, origin = rays->ray->origin;
    // A node's box has grown by at most BVH_SLACK, because coordinates of triangles are at most 1.
    const Real slack = BVH_SLACK * (largest_component(origin) + 1.0f);
    const Real3 slacks = real3_of(slack, slack, slack);
    extremes->inverse = lower3(extremes->inverse, inverse);
    extremes->minus_inverse = lower3(extremes->minus_inverse, negative3(inverse));
    extremes->behind = lower3(extremes->behind, difference(origin, slacks));
    extremes->minus_ahead = lower3(extremes->minus_ahead, negative3(sum3(origin, slacks)));
    extremes->minus_reach = min(extremes->minus_reach, -reach);
}

// Stores bounds over the packets whose bits are set. At least one bit must be set. Returns the
// largest distance at which the packets search.
static NOT_INLINE float bounds_over(const Packet *packets, const Hit *hits, uint bits,
                                    BeamBounds *bounds)
{
    const Real3 none = real3_of(INFINITY, INFINITY, INFINITY);
    Extremes extremes = {none, none, none, none, 0.0f};
    for (; bits != 0; bits &= bits - 1) {
        const Search *rays = &packets[lowest_bit(bits)].rays;
        include_rays(&extremes, rays, search_reach(rays, &hits[lowest_bit(bits)]));
    }
    const Real3 i = extremes.inverse, j = extremes.minus_inverse;
    const Real3 b = extremes.behind, a = extremes.minus_ahead;
    const float4 low = lowest_of_four(i.x, i.y, i.z, extremes.minus_reach);
    const float4 high = -lowest_of_four(j.x, j.y, j.z, j.z);
    const float4 behind = lowest_of_four(b.x, b.y, b.z, b.z);
    const float4 ahead = -lowest_of_four(a.x, a.y, a.z, a.z);
    // The origin farthest forward gives the earliest entry. The origin farthest back gives the
    // latest exit.
    const int4 negative = high < 0.0f;
    const float4 near = negative ? behind : ahead, far = negative ? ahead : behind;
    vstore4(as_uint4(negative) & 1, 0, bounds->negative);
    vstore4(low, 0, bounds->inverse_low);
    vstore4(high, 0, bounds->inverse_high);
    vstore4(-near * low, 0, bounds->near_low);
    vstore4(-near * high, 0, bounds->near_high);
    vstore4(-far * low, 0, bounds->far_low);
    vstore4(-far * high, 0, bounds->far_high);
    return -low.w;
}

static inline float8 entry_bound(float8 plane, const BeamBounds *bounds, uint axis)
{
    const float8 low =
        fma(plane, (float8)(bounds->inverse_low[axis]), (float8)(bounds->near_low[axis]));
    const float8 high =
        fma(plane, (float8)(bounds->inverse_high[axis]), (float8)(bounds->near_high[axis]));
    return min(low, high);
}

static inline float8 leave_bound(float8 plane, const BeamBounds *bounds, uint axis)
{
    const float8 low =
        fma(plane, (float8)(bounds->inverse_low[axis]), (float8)(bounds->far_low[axis]));
    const float8 high =
        fma(plane, (float8)(bounds->inverse_high[axis]), (float8)(bounds->far_high[axis]));
    return max(low, high);
}

// The planes by which rays enter and leave eight boxes.
typedef struct {
    Wide3 near, far;
} BoxPlanes;

// Returns the boxes that some ray may enter before `reach`. Stores lower bounds of the entry
// distances in *entry.
static ALWAYS_INLINE int8 boxes_near(const BoxPlanes *planes, const BeamBounds *bounds, float reach,
                                     float8 *entry)
{
    const Wide3 near = {entry_bound(planes->near.x, bounds, 0),
                        entry_bound(planes->near.y, bounds, 1),
                        entry_bound(planes->near.z, bounds, 2)};
    const Wide3 far = {leave_bound(planes->far.x, bounds, 0), leave_bound(planes->far.y, bounds, 1),
                       leave_bound(planes->far.z, bounds, 2)};
    *entry = entry_distance(near);
    return *entry <= leaving_distance(far, (float8)(reach));
}

static inline float8 node_plane(global const BvhWide *node, const BeamBounds *bounds, uint axis,
                                uint other)
{
    return vload8(0, node->planes[axis][bounds->negative[axis] ^ other]);
}

// Returns the children that some ray may enter before `reach`. Stores lower bounds of the entry
// distances in *entry.
static inline int8 children_near(global const BvhWide *node, const BeamBounds *bounds, float reach,
                                 float8 *entry)
{
    const BoxPlanes planes = {{node_plane(node, bounds, 0, 0), node_plane(node, bounds, 1, 0),
                               node_plane(node, bounds, 2, 0)},
                              {node_plane(node, bounds, 0, 1), node_plane(node, bounds, 1, 1),
                               node_plane(node, bounds, 2, 1)}};
    return boxes_near(&planes, bounds, reach, entry);
}

static inline float8 block_plane(global const TriangleBlock *block, const BeamBounds *bounds,
                                 uint axis, uint other)
{
    const float8 a = block_row(block, 0, axis), b = block_row(block, 1, axis);
    const float8 c = block_row(block, 2, axis);
    return (bounds->negative[axis] ^ other) ? max(max(a, b), c) : min(min(a, b), c);
}

// Returns the bits of the triangles that some ray may hit before `reach`, on average a third of the
// block. Testing one triangle against all lanes costs as much as this call.
static inline uint triangles_near(global const TriangleBlock *block, const BeamBounds *bounds,
                                  float reach)
{
    float8 entry;
    const BoxPlanes planes = {{block_plane(block, bounds, 0, 0), block_plane(block, bounds, 1, 0),
                               block_plane(block, bounds, 2, 0)},
                              {block_plane(block, bounds, 0, 1), block_plane(block, bounds, 1, 1),
                               block_plane(block, bounds, 2, 1)}};
    return lane_bits(boxes_near(&planes, bounds, reach, &entry));
}

#endif
#endif
