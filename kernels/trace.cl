// SPDX-License-Identifier: MIT
// Follows a camera ray through its reflections (Whitted, CACM 23(6) 1980).  OpenCL C has no
// recursion; what a recursive tracer keeps on its stack is the weight here.
#ifndef CLRT_TRACE_CL
#define CLRT_TRACE_CL
#include "shade.cl"

// sample_x and sample_y count sub-pixels across the whole picture.
static inline Ray camera_ray(const FrameData *frame, uint sample_x, uint sample_y)
{
    const float x = (float)((int)(2 * sample_x + 1) - (int)(frame->width * frame->samples));
    const float y = (float)((int)(2 * sample_y + 1) - (int)(frame->height * frame->samples));
    const CameraData *camera = &frame->camera;
    const float3 eye = (float3)(camera->eye[0], camera->eye[1], camera->eye[2]);
    const float3 right =
        (float3)(camera->right_step[0], camera->right_step[1], camera->right_step[2]);
    const float3 down = (float3)(camera->down_step[0], camera->down_step[1], camera->down_step[2]);
    const float3 forward = (float3)(camera->forward[0], camera->forward[1], camera->forward[2]);
    const float3 direction = fma((float3)(x), right, fma((float3)(y), down, forward));
    return (Ray){eye, direction, NOTHING, RAY_CAMERA, eye};
}

static inline float3 trace(const SceneView *scene, const FrameData *frame, Ray ray, Tally *tally)
{
    const float3 background =
        (float3)(frame->background[0], frame->background[1], frame->background[2]);
    float3 color = (float3)(0.0f);
    float weight = 1.0f;
    for (uint level = 0; level < frame->max_level; level++) {
        const Hit hit = nearest_hit(scene, frame, &ray, tally);
        if (CLRT_STATISTICS) {
            tally->camera_hits += level == 0 && hit.id != NOTHING;
            tally->reflected_rays += level > 0;
            tally->shaded_points += hit.id != NOTHING;
        }
        if (hit.id == NOTHING)
            break;
        const Surface surface = surface_at(scene, frame, &ray, hit);
        const float3 shaded = shade(scene, frame, &surface, tally);
        const float reflectivity = scene->materials[surface.material].reflectivity;
        if (!CLRT_MIRRORS || reflectivity == 0.0f)
            return color + weight * shaded;
        color += (weight * (1.0f - reflectivity)) * shaded;
        weight *= reflectivity;
        ray = ray_reflected(&surface);
    }
    return color + weight * background;
}

#endif
