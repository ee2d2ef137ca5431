// SPDX-License-Identifier: MIT
// Finds the nearest hit of a ray, or any primitive that blocks a shadow ray. All spheres are tested
// first. The program's kind of nodes then selects the search for triangles (pair.cl or regroup.cl).
//
// Invariant: the primitive with the smallest pair (distance, id) is hit. order.cl decides between
// triangles at almost equal distances. The hit does not depend on the tree or on the other rays.
#ifndef CLRT_INTERSECT_CL
#define CLRT_INTERSECT_CL
#include "pair.cl"
#include "regroup.cl"
#include "sphere.cl"

// Returns the distance to the sphere on which the ray starts. A reflected or refracted ray can hit
// this sphere again from inside. In scenes with glass, a shadow ray can hit it again, too. The
// shadow ray's direction is first scaled to length 1, as sphere_chord requires.
static inline Real own_sphere_distance(const Sphere *sphere, const Ray *ray, Mask is_own)
{
    const bool is_path = plain_kind(ray->kind) == RAY_REFLECTED;
    if (!(is_path || CLRT_GLASS) || !any_lane(is_own))
        return INFINITY;
    if (!any_lane(is_own && !leads_away(sphere, ray->origin, ray->direction)))
        return INFINITY;
    if (is_path)
        return sphere_chord(sphere, ray->origin, ray->direction);
    const Real scale = 1.0f / sqrt(dot_product(ray->direction, ray->direction));
    return scale * sphere_chord(sphere, ray->origin, scaled3(scale, ray->direction));
}

// Tests a sphere or its copy in the tree. `id` is the sphere's.
static inline void intersect_sphere(const Tracer *tracer, const Ray *ray, uint entry, uint id,
                                    Hit *best)
{
    const Sphere sphere = sphere_at(&tracer->spheres[entry]);
    const Mask is_own = ray->active && ray->own == id;
    const Mask is_other = ray->active && ray->own != id;
    const Real other = sphere_distance(&sphere, ray->origin, ray->direction, is_other);
    const Real t = is_own ? own_sphere_distance(&sphere, ray, is_own) : other;
    const Mask precedes = hit_precedes(t, id, best);
    best->t = precedes ? t : best->t;
    best->id = precedes ? (UInt)(id) : best->id;
    best->index = precedes ? (UInt)(id) : best->index;
    if (CLRT_STATISTICS)
        tracer->tally->sphere_tests += lane_count(ray->active);
}

// Walks the tree over the spheres (host/accel/sphere_tree.c) or, without a tree, tests all spheres.
static NOT_INLINE void walk_spheres(const Tracer *tracer, const Ray *ray, Hit *best)
{
    const FrameData *frame = tracer->frame;
    const bool has_tree = frame->sphere_entries > frame->sphere_count;
    const uint end = has_tree ? frame->sphere_entries : frame->sphere_count;
    for (uint entry = has_tree ? frame->sphere_count : 0; entry < end; entry++) {
        global const SphereData *data = &tracer->spheres[entry];
        const uint id = has_tree ? data->id : entry;
        if (id != NOTHING) {
            intersect_sphere(tracer, ray, entry, id, best);
            continue;
        }
        const Sphere bound = sphere_at(data);
        const Mask enters =
            may_meet_before(&bound, ray->origin, ray->direction, best->t, ray->active);
        entry = any_lane(enters) ? entry : data->next - 1;
    }
}

// With one loop for both, scenes of few spheres take 3 % longer on CPUs. With two loops, GPUs need
// 182 registers instead of 176.
static inline void intersect_spheres(const Tracer *tracer, const Ray *ray, Hit *best)
{
    const uint count = tracer->frame->sphere_count;
    if (CLRT_GPU || tracer->frame->sphere_entries > count)
        walk_spheres(tracer, ray, best);
    else
        for (uint id = 0; id < count; id++)
            intersect_sphere(tracer, ray, id, id, best);
}

// Returns whether the ray may search for triangles. The sum of the components' magnitudes must be
// below 2^46 for the start, and between 2^-80 and 2^80 for the direction. Other rays never search,
// so they hit no triangle. With an infinity or a NaN, a ray could be inside every box, even a
// missing child's, and the search would never end.
static inline Mask is_searchable(const Ray *ray)
{
    const Real3 o = magnitudes(ray->origin), d = magnitudes(ray->direction);
    const Real reach = o.x + o.y + o.z, size = d.x + d.y + d.z;
    return ray->active && reach < 0x1p46f && size > 0x1p-80f && size < 0x1p80f;
}

// Finds the hits on triangles in the lanes of `active`, by the search for which the program is
// compiled.
static inline void intersect_triangles(const Tracer *tracer, const Ray *rays,
                                       const Mask active[PACKETS], uint count, Hit *hits)
{
#if CLRT_WIDE_NODES
    uint bits[PACKETS], any = 0;
    for (uint i = 0; i < count; i++)
        any |= bits[i] = lane_bits(active[i]);
    if (any != 0)
        search_beams(tracer, rays, bits, count, hits);
#else
    if (active[0])
        search_pairs(tracer, rays, hits);
#endif
}

// Finds the nearest sphere before hit->t. Returns the lanes that then search for triangles.
static inline Mask meet_spheres(const Tracer *tracer, const Ray *ray, Hit *hit)
{
    if (!any_lane(ray->active))
        return 0;
    if (CLRT_SPHERES && tracer->frame->sphere_count != 0)
        intersect_spheres(tracer, ray, hit);
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
    if (CLRT_TRIANGLES && tracer->frame->triangle_count != 0)
        intersect_triangles(tracer, rays, searching, count, hits);
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
        if (!CLRT_GLASS)
            searching[i] = searching[i] && hits[i].id == NOTHING;
    }
    if (CLRT_TRIANGLES && tracer->frame->triangle_count != 0)
        intersect_triangles(tracer, rays, searching, count, hits);
}

static inline Hit nearest_hit(const Tracer *tracer, const Ray *ray)
{
    Hit hit;
    nearest_hits(tracer, ray, 1, &hit);
    return hit;
}

#endif
