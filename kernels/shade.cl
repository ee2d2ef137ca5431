// SPDX-License-Identifier: MIT
// What a surface looks like under the point lights, before reflection: silhouette, matte or
// Blinn-Phong (Blinn, "Models of light reflection for computer synthesized pictures", 1977).
#ifndef CLRT_SHADE_CL
#define CLRT_SHADE_CL
#include "surface.cl"

// Sums stay finite for lights of any intensity, so that 0 * sum is never a NaN.
#define BRIGHTEST 1e30f

static inline Ray ray_from_light(float3 light, const Surface *surface)
{
    return (Ray){light, surface->point - light, surface->id, RAY_SHADOW, surface->point};
}

// The highlight (n.h)^shininess.  Past integers the power is exp(shininess * log(n.h)) with n.h
// taken from |n - h|, which keeps its distance from 1: at shininess 1e6 pow of the rounded dot
// product is off by 0.14, this by 5e-5.
static inline float highlight(global const Material *material, float3 normal, float3 half_vector)
{
    if (material->exponent != 0xffffffffu) {
        const float cosine = dot_product(normal, half_vector);
        return integer_power(clamp(cosine, 0.0f, 1.0f), material->exponent);
    }
    const float3 apart = normal - half_vector;
    const float below_one = -0.5f * dot_product(apart, apart);
    if (!(below_one > -1.0f))
        return 0.0f;
    return exponential(material->shininess * log_one_plus(below_one));
}

static inline float3 half_vector_of(const Surface *surface, float3 toward_light)
{
    const float3 half_vector = unit_vector(toward_light + surface->toward_viewer);
    return largest_component(half_vector) > 0.0f ? half_vector : surface->normal;
}

// Light received by the surface: x diffuse, y specular.  Surfaces turned away from a light get
// nothing of it and need no shadow ray.
static inline float2 light_received(const SceneView *scene, const FrameData *frame,
                                    const Surface *surface, Tally *tally)
{
    global const Material *material = &scene->materials[surface->material];
    float2 sum = (float2)(0.0f);
    for (uint index = 0; index < frame->light_count; index++) {
        const float3 light = load3(scene->lights[index].position);
        const float intensity = scene->lights[index].intensity;
        const float3 toward_light = unit_vector(light - surface->point);
        const float cosine = dot_product(surface->normal, toward_light);
        if (!(cosine > 0.0f))
            continue;
        if (CLRT_STATISTICS)
            tally->shadow_rays++;
        const Ray ray = ray_from_light(light, surface);
        if (is_blocked(scene, frame, &ray, tally))
            continue;
        sum.x += intensity * cosine;
        if (CLRT_SPECULAR && material->shader == SHADER_BLINN_PHONG)
            sum.y += intensity *
                     highlight(material, surface->normal, half_vector_of(surface, toward_light));
    }
    return min(sum, (float2)(BRIGHTEST));
}

static inline float3 shade(const SceneView *scene, const FrameData *frame, const Surface *surface,
                           Tally *tally)
{
    global const Material *material = &scene->materials[surface->material];
    const float3 diffuse = load3(material->diffuse);
    if (material->shader == SHADER_SILHOUETTE)
        return diffuse;
    const float2 light = light_received(scene, frame, surface, tally);
    float3 color = diffuse * (frame->ambient + material->kd * light.x);
    if (CLRT_SPECULAR && material->shader == SHADER_BLINN_PHONG)
        color += load3(material->specular) * (material->ks * light.y);
    return clamp(color, 0.0f, 1.0f);
}

#endif
