// SPDX-License-Identifier: MIT
// Follows a camera ray through its reflections (Whitted, CACM 23(6) 1980). OpenCL C has no
// recursion, so the loop keeps the weight that a recursive tracer keeps on its stack.
#ifndef CLRT_TRACE_CL
#define CLRT_TRACE_CL
#include "shade.cl"

static inline Real3 load_private3(const float *components)
{
    return real3_of(components[0], components[1], components[2]);
}

// x and y are positions in the whole picture, in halves of a sub-pixel.
static inline Ray camera_ray_toward(const FrameData *frame, UInt x, UInt y, Mask active)
{
    const Real across = to_real(to_int(x) - (int)(frame->width * frame->samples));
    const Real along = to_real(to_int(y) - (int)(frame->height * frame->samples));
    const Real3 eye = load_private3(frame->camera.eye);
    const Real3 right = load_private3(frame->camera.right_step);
    const Real3 down = load_private3(frame->camera.down_step);
    const Real3 forward = load_private3(frame->camera.forward);
    const Real3 direction = {fma(across, right.x, fma(along, down.x, forward.x)),
                             fma(across, right.y, fma(along, down.y, forward.y)),
                             fma(across, right.z, fma(along, down.z, forward.z))};
    return (Ray){eye, direction, NOTHING, NOTHING, RAY_CAMERA, active};
}

// sample_x and sample_y count sub-pixels across the whole picture.
static inline Ray camera_ray(const FrameData *frame, UInt sample_x, UInt sample_y, Mask active)
{
    return camera_ray_toward(frame, 2 * sample_x + 1, 2 * sample_y + 1, active);
}

static inline void count_rays(Tally *tally, uint level, Mask active, Mask met)
{
    tally->camera_hits += level == 0 ? lane_count(met) : 0;
    tally->reflected_rays += level > 0 ? lane_count(active) : 0;
    tally->shaded_points += lane_count(met);
}

// Returns the surface's word for signatures. Each sphere is its own surface; all triangles of one
// material are one surface.
static inline UInt surface_word(const FrameData *frame, const Surface *surface)
{
    const UInt of_mesh = frame->sphere_count + surface->material;
    return surface->id < frame->sphere_count ? surface->id : of_mesh;
}

static inline Real3 trace(const Tracer *tracer, Ray ray)
{
    Real3 color = real3_of(0.0f, 0.0f, 0.0f);
    Real weight = 1.0f;
    Mask ended = 0; // at a surface that does not reflect
    for (uint level = 0; level < tracer->frame->max_level && any_lane(ray.active); level++) {
        const Hit hit = nearest_hit(tracer, &ray);
        const Mask met = ray.active && hit.id != NOTHING;
        if (CLRT_STATISTICS)
            count_rays(tracer->tally, level, ray.active, met);
        if (!any_lane(met))
            break;
        const Surface surface = surface_at(tracer, &ray, &hit, met);
        const MaterialLanes material = fetch_material(tracer, surface.material);
        sign_lanes(tracer->tally, met, surface_word(tracer->frame, &surface));
        const Lighting dark = lighting_of(&surface, &material, met);
        const Real3 shaded = shade(tracer, dark);
        Mask ends = met;
        if (CLRT_MIRRORS)
            ends = met && material.reflectivity == 0.0f;
        const Real share = ends ? weight : weight * (1.0f - material.reflectivity);
        color = choose3(met, sum3(color, scaled3(share, shaded)), color);
        weight = met && !ends ? weight * material.reflectivity : weight;
        ended = ended || ends;
        if (!CLRT_MIRRORS)
            break;
        ray = ray_reflected(tracer, &surface, met && !ends);
    }
    const Real3 background = load_private3(tracer->frame->background);
    return choose3(ended, color, sum3(color, scaled3(weight, background)));
}

#endif
