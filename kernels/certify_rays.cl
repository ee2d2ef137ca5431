// SPDX-License-Identifier: MIT
// Finds the rays whose hits rounding cannot have changed. A ray cone (certify_cone.cl) holds the
// caller's ray and the rounded ray that rays.cl traces. The kernel is compiled after render.cl with
// CLRT_FP64, and only if requested.
#include "certify_search.cl"

// Returns the distance between a ray's start and the sphere that it starts on.
static inline Real sphere_offset(const Tracer *tracer, Real3 origin, uint own)
{
    if (own >= tracer->frame->sphere_count)
        return 0.0f;
    const PlainSphere sphere = plain_sphere(&tracer->spheres[own]);
    return fabs(length_of(difference(origin, sphere.center)) - sphere.radius);
}

// The host rounds each component of the direction by u.
static inline RayCone given_cone(const Tracer *tracer, global const RayData *data, uint kind)
{
    const Real3 origin = load3(data->origin), along = unit_vector(load3(data->direction));
    const Real around = data->doubt + sphere_offset(tracer, origin, data->own);
    RayCone cone = {.origin = origin,
                    .around = around,
                    .spread = spread_of(1.01f * 0x1p-24f + 8.0f * OWN_ROUNDOFF),
                    .length = INFINITY,
                    .u = 0x1p-24f,
                    .own = data->own,
                    .own_index = data->own_index,
                    .kind = (RayKind)kind,
                    .start = {origin, along, 0.0f, around}};
    set_axis(&cone, along);
    return cone;
}

// Returns whether rounding cannot change the ray's hit, and stores its id. Rays that end within
// rounding of a hit are uncertain, and so are rays from anywhere that pass a sphere by name.
static inline bool certify_ray(const Tracer *tracer, global const RayData *data, uint kind,
                               uint *id)
{
    *id = NOTHING;
    if (data->limit < 0.0f)
        return data->doubt < 0x1p-5f;
    const RayCone ray = given_cone(tracer, data, kind);
    if (!is_usable(&ray) || (kind == RAY_CAMERA && data->own < tracer->frame->sphere_count))
        return false;
    const Nearest nearest = certify_nearest_hit(tracer, &ray);
    const Real end = data->limit * length_of(load3(data->direction));
    const Real doubt = 0x1p-21f * end + 2.0f * ray.around;
    if (min(nearest.low, nearest.other) > end + doubt)
        return true;
    *id = nearest.id;
    return nearest_is_certain(&nearest) &&
           (nearest.id == NOTHING || end == INFINITY || nearest.high < end - doubt);
}

// Stores in hits[i] the id of the primitive that ray i certainly hits, or NOTHING if it certainly
// hits none, with t = 0. t is INFINITY if the hit is uncertain. The arguments are those of
// trace_rays.
kernel void certify_rays(TRACER_ARGUMENTS, global const RayData *rays, uint count, uint kind,
                         global HitData *hits)
{
    const uint place = (uint)get_global_id(0);
    if (place >= count)
        return;
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    uint id;
    const bool is_certain = certify_ray(&tracer, &rays[place], kind, &id);
    hits[place] = (HitData){is_certain ? 0.0f : INFINITY, id};
}
