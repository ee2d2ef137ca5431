// SPDX-License-Identifier: MIT
// Finds the nearest sphere of a ray. If there are many spheres, rays search a tree over them. With
// pair nodes, this is a tree of bounding spheres (host/accel/sphere_tree.c). With wide nodes, it is
// a tree of boxes, as over triangles (beam_walk.cl).
//
// Invariant: trees only cull, and each sphere is tested by the same operations. The hit is
// therefore the same for every tree and without a tree.
#ifndef CLRT_SPHERES_CL
#define CLRT_SPHERES_CL
#include "crossings.cl"
#include "sphere.cl"

// Returns the distance to the sphere on which the ray starts. The direction of a shadow ray is
// first scaled to length 1, as sphere_chord requires.
static inline Real own_sphere_distance(const Sphere *sphere, const Ray *ray, Mask is_own)
{
    if (!may_hit_own_sphere(ray->kind) || !any_lane(is_own))
        return INFINITY;
    if (!any_lane(is_own && !leads_away(sphere, ray->origin, ray->direction)))
        return INFINITY;
    if (plain_kind(ray->kind) == RAY_REFLECTED)
        return sphere_chord(sphere, ray->origin, ray->direction);
    const Real scale = 1.0f / sqrt(dot_product(ray->direction, ray->direction));
    return scale * sphere_chord(sphere, ray->origin, scaled3(scale, ray->direction));
}

// Returns the distances at which the active rays hit spheres, one sphere per lane. `id` has the ids
// of the spheres.
static ALWAYS_INLINE Real sphere_ray_distance(const Sphere *sphere, const Ray *ray, UInt id)
{
    const Mask is_own = ray->active && ray->own == id;
    const Mask is_other = ray->active && ray->own != id;
    const Real other = sphere_distance(sphere, ray->origin, ray->direction, is_other);
    return is_own ? own_sphere_distance(sphere, ray, is_own) : other;
}

// Adds the active rays' crossings of a sphere's walls, up to `limit`.
static inline void cross_walls(const Tracer *tracer, const Ray *ray, const SphereWalls *walls,
                               uint id, Real limit)
{
    const Hit near = {walls->near, (UInt)(id), NOTHING}, far = {walls->far, (UInt)(id), NOTHING};
    add_crossings(tracer, ray, ray->active && near.t > 0.0f, &near, limit);
    add_crossings(tracer, ray, ray->active && far.t > 0.0f, &far, limit);
}

// Adds the active rays' crossings of a sphere. Only programs that find all hits call this function.
static NOT_INLINE void cross_sphere(const Tracer *tracer, const Ray *ray, const Sphere *sphere,
                                    uint id, Real limit)
{
    Ray near = *ray;
    near.active =
        sphere_is_near(sphere, ray->origin, ray->direction, ray->active && ray->own != id);
    if (!any_lane(near.active))
        return;
    const SphereWalls walls = exact_sphere_walls(sphere, ray->origin, ray->direction);
    cross_walls(tracer, &near, &walls, id, limit);
}

// Makes the sphere the best hit in each lane where it precedes the best hit so far.
static inline void accept_sphere(Real t, uint id, Hit *best)
{
    const Mask precedes = hit_precedes(t, (UInt)(id), best);
    best->t = precedes ? t : best->t;
    best->id = precedes ? (UInt)(id) : best->id;
    best->index = precedes ? (UInt)(id) : best->index;
}

// Tests a sphere against all lanes. `id` is the sphere's id.
static inline void intersect_sphere(const Tracer *tracer, const Ray *ray, const Sphere *sphere,
                                    uint id, Hit *best)
{
    if (CLRT_ALL_HITS)
        cross_sphere(tracer, ray, sphere, id, best->t);
    else
        accept_sphere(sphere_ray_distance(sphere, ray, (UInt)(id)), id, best);
    if (CLRT_STATISTICS)
        tracer->tally->sphere_tests += lane_count(ray->active);
}

static inline void intersect_all_spheres(const Tracer *tracer, const Ray *ray, Hit *best)
{
    for (uint id = 0; id < tracer->frame->sphere_count; id++) {
        const Sphere sphere = sphere_at(&tracer->spheres[id]);
        intersect_sphere(tracer, ray, &sphere, id, best);
    }
}

#if CLRT_WIDE_NODES

static inline bool has_sphere_tree(const Tracer *tracer)
{
    return CLRT_SPHERES && CLRT_BVH && tracer->frame->sphere_root != NOTHING;
}

#else

// Walks the tree over the spheres (host/accel/sphere_tree.c) or, without a tree, tests all spheres.
static NOT_INLINE void walk_spheres(const Tracer *tracer, const Ray *ray, Hit *best)
{
    const FrameData *frame = tracer->frame;
    const bool has_tree = frame->sphere_entries > frame->sphere_count;
    const uint end = has_tree ? frame->sphere_entries : frame->sphere_count;
    for (uint entry = has_tree ? frame->sphere_count : 0; entry < end; entry++) {
        global const SphereData *data = &tracer->spheres[entry];
        const uint id = has_tree ? data->id : entry;
        const Sphere sphere = sphere_at(data);
        if (id != NOTHING) {
            intersect_sphere(tracer, ray, &sphere, id, best);
            continue;
        }
        const Mask enters =
            may_meet_before(&sphere, ray->origin, ray->direction, best->t, ray->active);
        entry = any_lane(enters) ? entry : data->next - 1;
    }
}

// On GPUs, walk_spheres also serves scenes without a tree over spheres, because one loop needs 176
// registers and two loops 182.
static inline void intersect_spheres(const Tracer *tracer, const Ray *ray, Hit *best)
{
    if (CLRT_GPU || tracer->frame->sphere_entries > tracer->frame->sphere_count)
        walk_spheres(tracer, ray, best);
    else
        intersect_all_spheres(tracer, ray, best);
}

#endif
#endif
