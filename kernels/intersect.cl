// SPDX-License-Identifier: MIT
// Finds a ray's hit: the smallest (distance, id) of all primitives, or whether anything blocks a
// shadow ray.
#ifndef CLRT_INTERSECT_CL
#define CLRT_INTERSECT_CL
#include "packet_search.cl"
#include "pair.cl"
#include "sphere.cl"

// The search for triangles in the tree that the program is compiled for.
#if CLRT_WIDE_NODES
#define intersect_triangles search_packets
#else
#define intersect_triangles search_pairs
#endif

// A ray hits its own sphere only from inside, and only by reflection.
static inline Real own_sphere_distance(const Sphere *sphere, const Ray *ray, Mask is_own)
{
    if (ray->kind != RAY_REFLECTED || !any_lane(is_own))
        return INFINITY;
    return sphere_chord(sphere, ray->origin, ray->direction);
}

static inline void intersect_spheres(const Tracer *tracer, const Ray *ray, Hit *best)
{
    for (uint index = 0; index < tracer->frame->sphere_count; index++) {
        const Sphere sphere = sphere_at(&tracer->spheres[index]);
        const Mask is_own = ray->active && ray->own == index;
        const Mask is_other = ray->active && ray->own != index;
        const Real other = sphere_distance(&sphere, ray->origin, ray->direction, is_other);
        const Real t = is_own ? own_sphere_distance(&sphere, ray, is_own) : other;
        const Mask precedes = hit_precedes(t, index, best);
        best->t = precedes ? t : best->t;
        best->id = precedes ? (UInt)(index) : best->id;
        best->index = precedes ? (UInt)(index) : best->index;
        if (CLRT_STATISTICS)
            tracer->tally->sphere_tests += lane_count(ray->active);
    }
}

// Returns whether a search for triangles may follow the ray. The ray must start within 2^46 of the
// frame, and its direction must be between 2^-80 and 2^80 long. All other rays hit nothing. With
// an infinity or a NaN, a ray would be inside every box, even a missing child's, and the search
// would never end.
static inline Mask is_searchable(const Ray *ray)
{
    const Real3 o = magnitudes(ray->origin), d = magnitudes(ray->direction);
    const Real reach = o.x + o.y + o.z, size = d.x + d.y + d.z;
    return ray->active && reach < 0x1p46f && size > 0x1p-80f && size < 0x1p80f;
}

static inline Hit nearest_hit(const Tracer *tracer, const Ray *ray)
{
    Hit best = {INFINITY, NOTHING, NOTHING};
    if (CLRT_SPHERES)
        intersect_spheres(tracer, ray, &best);
    if (!CLRT_TRIANGLES || tracer->frame->triangle_count == 0)
        return best;
    Ray searching = *ray;
    searching.active = is_searchable(ray);
    if (any_lane(searching.active))
        intersect_triangles(tracer, &searching, &best);
    return best;
}

// Returns anything between the shaded point and the light of a shadow ray. If nothing blocks it,
// the hit has no id, and t is the limit of the search. A primitive that the light lies on, within
// the error of a distance, does not block it.
static inline Hit blocking_hit(const Tracer *tracer, const Ray *ray)
{
    Hit best = {1.0f - 16.0f * UNIT_ROUNDOFF, NOTHING, NOTHING};
    if (CLRT_SPHERES)
        intersect_spheres(tracer, ray, &best);
    Ray rest = *ray;
    rest.active = is_searchable(ray) && best.id == NOTHING;
    if (!CLRT_TRIANGLES || tracer->frame->triangle_count == 0 || !any_lane(rest.active))
        return best;
    intersect_triangles(tracer, &rest, &best);
    return best;
}

static inline Mask is_blocked(const Tracer *tracer, const Ray *ray)
{
    const Hit blocker = blocking_hit(tracer, ray);
    return blocker.id != NOTHING;
}

#endif
