// SPDX-License-Identifier: MIT
// Finds the rays whose hits do not depend on rounding. A ray cone (certify_cone.cl) contains the
// caller's ray and the rounded ray that rays.cl traces. The kernel needs CLRT_FP64, and is compiled
// only if requested.
#include "certify_search.cl"

// Returns the distance between a ray's start and the sphere that the ray leaves, or 0 if it leaves
// no sphere.
static inline Real sphere_offset(const Tracer *tracer, Real3 origin, uint own)
{
    if (own >= tracer->frame->sphere_count)
        return 0.0f;
    const PlainSphere sphere = plain_sphere(&tracer->spheres[own]);
    return fabs(length_of(difference(origin, sphere.center)) - sphere.radius);
}

static inline Real3 ray_vector(global const float components[3][RAY_BLOCK], uint ray)
{
    return real3_of(components[0][ray], components[1][ray], components[2][ray]);
}

// Returns the cone of a caller's ray. The host has rounded each component of the ray's direction,
// with a relative error of at most 2^-24.
static inline RayCone given_cone(const Tracer *tracer, global const RayBlock *block, uint ray)
{
    const uint own = block->own[ray], own_index = block->own_index[ray];
    const bool starts = own_index != NOTHING;
    const bool on_triangle = starts && own >= tracer->frame->sphere_count;
    const Real3 origin = ray_vector(block->origin, ray);
    const Real3 along = unit_vector(ray_vector(block->direction, ray));
    const Real around = block->doubt[ray] + sphere_offset(tracer, origin, own);
    RayCone cone = {.origin = origin,
                    .around = around,
                    .spread = spread_of(1.01f * 0x1p-24f + 8.0f * OWN_ROUNDOFF),
                    .length = INFINITY,
                    .u = 0x1p-24f,
                    .own = own,
                    .own_index = on_triangle ? own_index : NOTHING,
                    .kind = starts ? RAY_REFLECTED : RAY_CAMERA,
                    .start = {origin, along, 0.0f, around}};
    set_axis(&cone, along);
    return cone;
}

// Returns whether `hit` is certain, which means that rounding cannot change the ray's hit. The hit
// is also uncertain if it is within rounding of the ray's end, or if the ray ignores a sphere on
// which it does not start.
static NOT_INLINE bool certify_ray(const Tracer *tracer, global const RayBlock *block, uint number,
                                   uint hit)
{
    if (block->limit[number] < 0.0f)
        return block->doubt[number] < 0x1p-5f;
    const RayCone ray = given_cone(tracer, block, number);
    if (!is_usable(&ray) || (ray.kind == RAY_CAMERA && ray.own < tracer->frame->sphere_count))
        return false;
    const Nearest nearest = certify_nearest_hit(tracer, &ray);
    const Real end = block->limit[number] * length_of(ray_vector(block->direction, number));
    const Real doubt = 0x1p-21f * end + 2.0f * ray.around;
    if (min(nearest.low, nearest.other) > end + doubt)
        return hit == NOTHING;
    return nearest_is_certain(&nearest) && nearest.id == hit &&
           (hit == NOTHING || end == INFINITY || nearest.high < end - doubt);
}

// Stores in counts[i] whether hits[i], the result of trace_rays for ray i, is certain. Both kernels
// have the same arguments.
kernel void certify_rays(TRACER_ARGUMENTS, global const RayBlock *blocks, uint count, uint kinds,
                         uint room, global const HitData *hits, global uint *counts)
{
    (void)kinds, (void)room;
    const uint place = (uint)get_global_id(0);
    if (place >= count)
        return;
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    counts[place] =
        certify_ray(&tracer, &blocks[place / RAY_BLOCK], place % RAY_BLOCK, hits[place].id);
}
