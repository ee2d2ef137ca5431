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
// fma(plane, inverse_low, far_low) and fma(plane, inverse_high, far_high).
typedef struct {
    uint negative; // the rays enter by the higher plane
    float inverse_low, inverse_high;
    float near_low, near_high, far_low, far_high;
} AxisBounds;

typedef struct {
    AxisBounds axes[3];
} Bounds;

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

// The extremes of rays' inverse directions and origins on an axis, lane by lane. Each origin moves
// by its own slack, and by the slack of node boxes, which the boxes of single triangles lack.
typedef struct {
    Real inverse_low, inverse_high, behind, ahead;
} AxisRange;

static inline void include_rays(AxisRange *range, Real inverse, Real origin, Real slack)
{
    range->inverse_low = min(range->inverse_low, inverse);
    range->inverse_high = max(range->inverse_high, inverse);
    range->behind = min(range->behind, origin - slack);
    range->ahead = max(range->ahead, origin + slack);
}

// The origin farthest forward gives the earliest entry, the one farthest back the latest exit.
static inline AxisBounds axis_bounds(const AxisRange *range)
{
    const float low = lowest(range->inverse_low), high = highest(range->inverse_high);
    const float least = lowest(range->behind), most = highest(range->ahead);
    const bool negative = high < 0.0f;
    const float near = negative ? least : most, far = negative ? most : least;
    return (AxisBounds){negative, low, high, -near * low, -near * high, -far * low, -far * high};
}

// Returns bounds over the packets whose bits are set. At least one bit must be set.
static NOT_INLINE Bounds bounds_over(const Packet *packets, uint bits)
{
    const AxisRange none = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    AxisRange x = none, y = none, z = none;
    for (; bits != 0; bits &= bits - 1) {
        const Search *rays = &packets[lowest_bit(bits)].rays;
        const Real3 inverse = rays->slabs.inverse, origin = rays->ray->origin;
        // Triangle coordinates are at most 1.
        const Real slack = BVH_SLACK * (largest_component(origin) + 1.0f);
        include_rays(&x, inverse.x, origin.x, slack);
        include_rays(&y, inverse.y, origin.y, slack);
        include_rays(&z, inverse.z, origin.z, slack);
    }
    return (Bounds){{axis_bounds(&x), axis_bounds(&y), axis_bounds(&z)}};
}

static inline float8 entry_bound(float8 plane, const AxisBounds *bounds)
{
    const float8 low = fma(plane, (float8)(bounds->inverse_low), (float8)(bounds->near_low));
    const float8 high = fma(plane, (float8)(bounds->inverse_high), (float8)(bounds->near_high));
    return min(low, high);
}

static inline float8 leave_bound(float8 plane, const AxisBounds *bounds)
{
    const float8 low = fma(plane, (float8)(bounds->inverse_low), (float8)(bounds->far_low));
    const float8 high = fma(plane, (float8)(bounds->inverse_high), (float8)(bounds->far_high));
    return max(low, high);
}

// Returns the planes by which the rays enter the children's boxes. If other is 1, returns the
// planes by which they leave.
static inline float8 node_plane(global const BvhWide *node, const Bounds *bounds, uint axis,
                                uint other)
{
    return vload8(0, node->planes[axis][bounds->axes[axis].negative ^ other]);
}

// Returns the children that some ray may enter before `reach`. Stores lower bounds of the entry
// distances in *entry.
static inline int8 children_near(global const BvhWide *node, const Bounds *bounds, float reach,
                                 float8 *entry)
{
    const float8 near_x = entry_bound(node_plane(node, bounds, 0, 0), &bounds->axes[0]);
    const float8 near_y = entry_bound(node_plane(node, bounds, 1, 0), &bounds->axes[1]);
    const float8 near_z = entry_bound(node_plane(node, bounds, 2, 0), &bounds->axes[2]);
    const float8 far_x = leave_bound(node_plane(node, bounds, 0, 1), &bounds->axes[0]);
    const float8 far_y = leave_bound(node_plane(node, bounds, 1, 1), &bounds->axes[1]);
    const float8 far_z = leave_bound(node_plane(node, bounds, 2, 1), &bounds->axes[2]);
    *entry = max(max(near_x, near_y), max(near_z, (float8)(0.0f)));
    return *entry <= min(min(far_x, far_y), min(far_z, (float8)(reach)));
}

// Returns the planes by which the rays enter the triangles' boxes. If other is 1, returns the
// planes by which they leave.
static inline float8 block_plane(global const TriangleBlock *block, const Bounds *bounds, uint axis,
                                 uint other)
{
    const float8 a = block_row(block, 0, axis), b = block_row(block, 1, axis);
    const float8 c = block_row(block, 2, axis);
    return (bounds->axes[axis].negative ^ other) ? max(max(a, b), c) : min(min(a, b), c);
}

// Returns the bits of the triangles that some ray may hit before `reach`, on average a third of the
// block. Testing one triangle against all lanes costs as much as this call. A box test shared with
// children_near would make pictures 2 to 4 % slower.
static inline uint triangles_near(global const TriangleBlock *block, const Bounds *bounds,
                                  float reach)
{
    const float8 near_x = entry_bound(block_plane(block, bounds, 0, 0), &bounds->axes[0]);
    const float8 near_y = entry_bound(block_plane(block, bounds, 1, 0), &bounds->axes[1]);
    const float8 near_z = entry_bound(block_plane(block, bounds, 2, 0), &bounds->axes[2]);
    const float8 far_x = leave_bound(block_plane(block, bounds, 0, 1), &bounds->axes[0]);
    const float8 far_y = leave_bound(block_plane(block, bounds, 1, 1), &bounds->axes[1]);
    const float8 far_z = leave_bound(block_plane(block, bounds, 2, 1), &bounds->axes[2]);
    const float8 entry = max(max(near_x, near_y), max(near_z, (float8)(0.0f)));
    return lane_bits(entry <= min(min(far_x, far_y), min(far_z, (float8)(reach))));
}

#endif
#endif
