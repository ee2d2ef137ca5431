// SPDX-License-Identifier: MIT
// Finds the nearest hit of a ray, or any primitive that blocks a shadow ray. Spheres are tested
// before triangles. The program's kind of nodes selects the search (pair.cl or regroup.cl).
//
// Invariant: the primitive with the smallest pair (distance, id) is hit. order.cl decides between
// triangles at almost equal distances. The hit does not depend on the tree or on the other rays.
#ifndef CLRT_INTERSECT_CL
#define CLRT_INTERSECT_CL
#include "pair.cl"
#include "regroup.cl"
#include "spheres.cl"

// Returns whether the ray may search a tree of boxes or a list of triangles. The sum of the
// components' magnitudes must be below 2^46 for the start, and between 2^-80 and 2^80 for the
// direction. Other rays hit no triangle, and are tested against every sphere. With an infinity or a
// NaN, a ray could be inside every box, even the box of a missing child, and the search would never
// end.
static inline Mask is_searchable(const Ray *ray)
{
    const Real3 o = magnitudes(ray->origin), d = magnitudes(ray->direction);
    const Real reach = o.x + o.y + o.z, size = d.x + d.y + d.z;
    return ray->active && reach < 0x1p46f && size > 0x1p-80f && size < 0x1p80f;
}

#if CLRT_WIDE_NODES
// Returns whether the scene has primitives that meet_spheres leaves to intersect_search.
static inline bool has_search(const Tracer *tracer)
{
    return (CLRT_TRIANGLES && tracer->frame->triangle_count != 0) || has_sphere_tree(tracer);
}

// Finds the hits of the lanes in `active`: on triangles and, if there is a tree over spheres, on
// spheres.
static inline void intersect_search(const Tracer *tracer, const Ray *rays,
                                    const Mask active[PACKETS], uint count, Hit *hits)
{
    uint bits[PACKETS], any = 0;
    for (uint i = 0; i < count; i++)
        any |= bits[i] = lane_bits(active[i]);
    if (any != 0)
        search_beams(tracer, rays, bits, count, hits);
}

// Finds the nearest sphere for the rays that may not search the tree over spheres.
static NOT_INLINE void meet_far_spheres(const Tracer *tracer, const Ray *ray, Mask searching,
                                        Hit *hit)
{
    Ray far = *ray;
    far.active = ray->active && !searching;
    if (any_lane(far.active))
        intersect_all_spheres(tracer, &far, hit);
}
#else
static inline bool has_search(const Tracer *tracer)
{
    return CLRT_TRIANGLES && tracer->frame->triangle_count != 0;
}

static inline void intersect_search(const Tracer *tracer, const Ray *rays,
                                    const Mask active[PACKETS], uint count, Hit *hits)
{
    (void)count;
    if (active[0])
        search_pairs(tracer, rays, hits);
}
#endif

// Finds the nearest sphere before hit->t, or leaves it to intersect_search. Returns the lanes for
// which the caller must call intersect_search.
static inline Mask meet_spheres(const Tracer *tracer, const Ray *ray, Hit *hit)
{
    if (!any_lane(ray->active))
        return 0;
    if (!CLRT_SPHERES || tracer->frame->sphere_count == 0)
        return is_searchable(ray);
#if CLRT_WIDE_NODES
    if (!has_sphere_tree(tracer))
        intersect_all_spheres(tracer, ray, hit);
    else
        meet_far_spheres(tracer, ray, is_searchable(ray), hit);
#else
    intersect_spheres(tracer, ray, hit);
#endif
    return is_searchable(ray);
}

// Finds the nearest hits of `count` packets, at most PACKETS. blocking_hits repeats the loop: with
// a shared loop, PoCL 6.0 aborts when it compiles some fp64 kernels (LLVM 19: "did not reach a
// fixpoint").
static inline void nearest_hits(const Tracer *tracer, const Ray *rays, uint count, Hit *hits)
{
    Mask searching[PACKETS];
    for (uint i = 0; i < count; i++) {
        hits[i] = (Hit){INFINITY, NOTHING, NOTHING};
        searching[i] = meet_spheres(tracer, &rays[i], &hits[i]);
    }
    if (has_search(tracer))
        intersect_search(tracer, rays, searching, count, hits);
}

// Finds whether a primitive is between each shadow ray's start and the light. If nothing blocks a
// ray, its hit has the id NOTHING, and t is the limit of the search. If the light is within
// rounding of a primitive, this primitive does not block the ray. With glass, the hit is the
// nearest one.
static inline void blocking_hits(const Tracer *tracer, const Ray *rays, uint count, Hit *hits)
{
    Mask searching[PACKETS];
    for (uint i = 0; i < count; i++) {
        hits[i] = (Hit){1.0f - 16.0f * UNIT_ROUNDOFF, NOTHING, NOTHING};
        searching[i] = meet_spheres(tracer, &rays[i], &hits[i]);
        if (ends_at_any_hit(RAY_SHADOW))
            searching[i] = searching[i] && hits[i].id == NOTHING;
    }
    if (has_search(tracer))
        intersect_search(tracer, rays, searching, count, hits);
}

static inline Hit nearest_hit(const Tracer *tracer, const Ray *ray)
{
    Hit hit;
    nearest_hits(tracer, ray, 1, &hit);
    return hit;
}

#endif
