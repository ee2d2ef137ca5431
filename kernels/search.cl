// SPDX-License-Identifier: MIT
// Prepares rays for the tests against boxes and triangles.
//
// Invariant: boxes never cull a triangle or sphere that its test would accept. The hit is therefore
// the same for every tree, for every traversal order and without a tree.
//
// To ensure this, the host grows each box by BVH_SLACK times its largest coordinate. slabs_of moves
// the ray's origin by BVH_SLACK times the origin's largest coordinate, forward for near planes and
// back for far planes. The growth and the move together cover the rounding of the triangle test and
// of the box test (shared.h).
#ifndef CLRT_SEARCH_CL
#define CLRT_SEARCH_CL
#include "ray.cl"

// z is the axis of the direction's largest component. The shear makes the ray parallel to this
// axis. x and y are the two axes that follow z cyclically.
typedef struct {
    UInt x, y, z;
} ShearAxes;

static inline ShearAxes shear_axes(Real3 direction)
{
    const Real3 size = magnitudes(direction);
    const UInt second = size.y > size.x ? (UInt)(1) : (UInt)(0);
    ShearAxes axes;
    axes.z = size.z > max(size.x, size.y) ? (UInt)(2) : second;
    axes.x = axes.z == 2 ? (UInt)(0) : axes.z + 1;
    axes.y = axes.x == 2 ? (UInt)(0) : axes.x + 1;
    return axes;
}

static inline Shear shear_along(Real3 direction, const ShearAxes *axes)
{
    Shear shear;
    shear.direction_z = component(direction, axes->z);
    shear.inverse_z = 1.0f / shear.direction_z;
    shear.shear_x = component(direction, axes->x) * shear.inverse_z;
    shear.shear_y = component(direction, axes->y) * shear.inverse_z;
    return shear;
}

static inline Real3 axes_ordered(Real3 v, const ShearAxes *axes)
{
    return real3_of(component(v, axes->x), component(v, axes->y), component(v, axes->z));
}

// The slab test's constants: distance to a plane = fma(plane, inverse, offset).
typedef struct {
    Real3 inverse, near_offset, far_offset;
} Slabs;

// Raises the magnitude of a direction's component to at least `smallest`, which is 2^-30 of the
// largest one (docs/numerics.md, B8). The inverses are then finite if the largest component exceeds
// 2^-96. is_searchable rejects shorter directions.
static inline Real slab_direction(Real direction, Real smallest)
{
    return fabs(direction) < smallest ? copysign(smallest, direction) : direction;
}

static inline Slabs slabs_of(Real3 origin, Real3 direction)
{
    const Real smallest = 0x1p-30f * largest_component(direction);
    const Real slack = BVH_SLACK * largest_component(origin);
    const Real x = slab_direction(direction.x, smallest);
    const Real y = slab_direction(direction.y, smallest);
    const Real z = slab_direction(direction.z, smallest);
    const Real3 widening = {copysign(slack, x), copysign(slack, y), copysign(slack, z)};
    const Real3 near = sum3(origin, widening), far = difference(origin, widening);
    const Real3 inverse = {1.0f / x, 1.0f / y, 1.0f / z};
    return (Slabs){inverse,
                   {-near.x * inverse.x, -near.y * inverse.y, -near.z * inverse.z},
                   {-far.x * inverse.x, -far.y * inverse.y, -far.z * inverse.z}};
}

// A search in a tree or a list, with the prepared rays of all lanes. Only the tests against
// triangles use `limit` and the members from `axes` on.
typedef struct {
    const Tracer *tracer;
    const Ray *ray;
    Slabs slabs;
    Real limit; // distance of the nearest sphere, or the ray's end if it hits no sphere
    Real tie;   // rounding may exchange two triangles whose distances differ by this or less
    ShearAxes axes;
    Shear shear;
    Real3 backward; // minus the origin, in the order of the axes
} Search;

// Prepares the tests against boxes. If a tree over spheres is searched first, the caller updates
// `limit` before the search for triangles (see Search).
static inline void search_boxes(Search *search, const Tracer *tracer, const Ray *ray, Real limit)
{
    search->tracer = tracer;
    search->ray = ray;
    search->slabs = slabs_of(ray->origin, ray->direction);
    search->limit = limit;
    // triangle_depth_error is at most 54 u (o + 1) for the origin's largest coordinate o, because
    // coordinates of corners are at most 1 (B4). t is the depth times the inverse of the
    // direction's largest component. This factor is the smallest of the three inverses, and turns
    // the error of the depth into an error of t.
    const Real3 inverse = magnitudes(search->slabs.inverse);
    const Real unit = UNIT_ROUNDOFF * min(min(inverse.x, inverse.y), inverse.z);
    search->tie = 128.0f * unit * (largest_component(ray->origin) + 1.0f);
}

// Prepares the tests against triangles.
static inline void search_shear(Search *search)
{
    const Ray *ray = search->ray;
    search->axes = shear_axes(ray->direction);
    search->shear = shear_along(ray->direction, &search->axes);
    search->backward = axes_ordered(negative3(ray->origin), &search->axes);
}

static inline Search search_along(const Tracer *tracer, const Ray *ray, Real limit)
{
    Search search;
    search_boxes(&search, tracer, ray, limit);
    search_shear(&search);
    return search;
}

// Returns how far rounding may put the ray's start beyond a triangle that should stop the ray (B9).
static inline Real search_behind(const Search *search)
{
    return 256.0f * UNIT_ROUNDOFF * fabs(search->shear.inverse_z) *
           largest_component(search->ray->origin);
}

// Returns the distance beyond which no triangle precedes the best hit. By nearness, a triangle may
// precede the best hit although its t is larger by up to `tie` (order.cl). The box of a small
// triangle can be narrower than `tie`, so boxes must not be culled at the best distance itself.
static inline Real search_reach(const Search *search, const Hit *best)
{
    return best->t + search->tie;
}

#endif
