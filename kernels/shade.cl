// SPDX-License-Identifier: MIT
// Computes the color of a surface under the point lights, without reflections. The surface's shader
// is silhouette, matte or Blinn-Phong (Blinn, "Models of light reflection for computer synthesized
// pictures", 1977).
#ifndef CLRT_SHADE_CL
#define CLRT_SHADE_CL
#include "shadow.cl"

// Sums of light are limited to this number. They then stay finite for lights of any intensity, so
// that 0 * sum is never a NaN.
#define BRIGHTEST ((Real)(1e30f))

// Returns (n.h)^shininess for the normal n and the half vector h. If shininess is an integer up to
// 1024, integer_power computes it. Otherwise, the highlight is exp(shininess * log(n.h)). The
// logarithm is computed as log(1 - |n - h|^2 / 2), which avoids cancellation near n.h = 1. At
// shininess 1e6, the error is then 5e-5. With pow of the rounded dot product, the error would be
// 0.14.
static inline Real highlight(const MaterialLanes *material, Real3 normal, Real3 half_vector)
{
    const Mask is_integer = material->exponent != 0xffffffffu;
    const Real cosine = dot_product(normal, half_vector);
    const UInt exponent = is_integer ? material->exponent : (UInt)(0);
    const Real power = integer_power(clamp_to_one(cosine), exponent);
    if (!any_lane(!is_integer))
        return power;
    const Real3 apart = difference(normal, half_vector);
    const Real below_one = -0.5f * dot_product(apart, apart);
    const Real smooth = exponential(material->shininess * log_one_plus(below_one));
    const Real other = below_one > -1.0f ? smooth : 0.0f;
    return is_integer ? power : other;
}

static inline Real3 half_vector_of(const Surface *surface, Real3 toward_light)
{
    const Real3 half_vector = unit_vector(sum3(toward_light, surface->toward_viewer));
    return choose3(has_length(half_vector), half_vector, surface->normal);
}

// A light as seen from a surface.
typedef struct {
    Real3 position, toward; // toward: unit vector to the light
    float intensity;
    Real cosine;
    Mask faces; // the shading normal and the face both face the light
} LightSample;

// Returns whether the light is in front of the face. The light's height over a triangle is measured
// from a corner, because corners are exact. All points of a triangle therefore agree about a light
// that is nearly in the triangle's plane.
static inline Mask is_before_face(const Surface *surface, Real3 light)
{
    return dot_product(surface->face, difference(light, surface->a)) > 0.0f;
}

static inline LightSample sample_light(const Tracer *tracer, uint index, const Surface *surface,
                                       Mask wanted)
{
    LightSample light;
    light.position = load3(tracer->lights[index].position);
    light.intensity = tracer->lights[index].intensity;
    light.toward = unit_vector(difference(light.position, surface->point));
    light.cosine = dot_product(surface->normal, light.toward);
    light.faces = wanted && light.cosine > 0.0f && is_before_face(surface, light.position);
    return light;
}

// Returns the shadow ray. The ray starts at the surface, because hits near a ray's start are the
// most precise. Light from any distance therefore leaks through no edge of a closed shape. If
// shadow rays started at the light, packets would be 2 % faster in small scenes and slower in large
// scenes.
static inline Ray ray_to_light(const Tracer *tracer, const Surface *surface,
                               const LightSample *light)
{
    Heading heading = {light->position, true};
    const Real sine = fabs(dot_product(surface->face, light->toward));
    const Real3 point = point_left(tracer, surface, &heading, sine, light->faces);
    return (Ray){read3(&point), difference(light->position, point),
                 surface->id,   surface->index,
                 RAY_SHADOW,    light->faces};
}

// The surfaces and materials of a packet, and the lanes that need light.
typedef struct {
    const Surface *surface;
    const MaterialLanes *material;
    Mask wanted;
} Lighting;

static inline Lighting lighting_of(const Surface *surface, const MaterialLanes *material, Mask met)
{
    const Mask wanted = any_lane(met) ? met && IS_SHADED(material->shader) : met;
    return (Lighting){surface, material, wanted};
}

// One light's contribution without the colors of light and surface: intensity times cosine, and
// intensity times highlight.
typedef struct {
    Real diffuse, specular;
} Received;

// Returns the contribution of a light that reaches the lanes in `is_lit`.
static inline Received receive_light(const LightSample *light, const Lighting *lighting,
                                     Mask is_lit)
{
    const Surface *surface = lighting->surface;
    Received received = {is_lit ? light->intensity * light->cosine : (Real)(0.0f), 0.0f};
    const Mask shines = is_lit && lighting->material->shader == SHADER_BLINN_PHONG;
    if (!any_lane(shines))
        return received;
    const Real3 half_vector = half_vector_of(surface, light->toward);
    const Real shine =
        light->intensity * highlight(lighting->material, surface->normal, half_vector);
    received.specular = shines ? shine : (Real)(0.0f);
    return received;
}

typedef struct {
    Real3 diffuse, specular;
} Illumination;

// Adds a light's contributions to the surfaces. Surfaces turned away from the light get nothing and
// need no shadow ray.
static inline void add_light(const Tracer *tracer, uint index, const Lighting lighting[PACKETS],
                             Illumination sums[PACKETS])
{
    const Real3 color = load3(tracer->lights[index].color);
    LightSample light[PACKETS];
    Ray rays[PACKETS];
    LightPath path;
    for (uint i = 0; i < PACKETS; i++) {
        rays[i].active = 0;
        light[i].faces = 0;
        if (!any_lane(lighting[i].wanted))
            continue;
        light[i] = sample_light(tracer, index, lighting[i].surface, lighting[i].wanted);
        if (!any_lane(light[i].faces))
            continue;
        rays[i] = ray_to_light(tracer, lighting[i].surface, &light[i]);
        if (CLRT_STATISTICS)
            tracer->tally->shadow_rays += lane_count(light[i].faces);
    }
    light_blockers(tracer, rays, PACKETS, load3(tracer->lights[index].position), &path);
    for (uint i = 0; i < PACKETS; i++) {
        const Mask is_lit = light[i].faces && path.blockers[i].id == NOTHING;
        if (!any_lane(is_lit))
            continue;
        const Received received = receive_light(&light[i], &lighting[i], is_lit);
        const Real3 seen = tinted(&path, i, color);
        sums[i].diffuse = sum3(sums[i].diffuse, scaled3(received.diffuse, seen));
        sums[i].specular = sum3(sums[i].specular, scaled3(received.specular, seen));
    }
}

// Returns (ambient + weight * received) * color for each component.
static inline Real3 reflected_light(Real weight, Real3 received, Real ambient, Real3 color)
{
    return real3_of((ambient + weight * min(received.x, BRIGHTEST)) * color.x,
                    (ambient + weight * min(received.y, BRIGHTEST)) * color.y,
                    (ambient + weight * min(received.z, BRIGHTEST)) * color.z);
}

// Returns the color of a surface. `light` is the light that the surface receives from all lights.
static inline Real3 shaded_color(const Tracer *tracer, const MaterialLanes *material,
                                 const Illumination *light)
{
    const Real3 shine = reflected_light(material->ks, light->specular, 0.0f, material->specular);
    Real3 color =
        reflected_light(material->kd, light->diffuse, tracer->frame->ambient, material->diffuse);
    color = choose3(material->shader == SHADER_BLINN_PHONG, sum3(color, shine), color);
    color = real3_of(clamp_to_one(color.x), clamp_to_one(color.y), clamp_to_one(color.z));
    return choose3(material->shader == SHADER_SILHOUETTE, material->diffuse, color);
}

// Computes the surfaces' colors. The colors of lanes without a surface are unspecified.
static inline void shade(const Tracer *tracer, const Lighting lighting[PACKETS],
                         Real3 colors[PACKETS])
{
    Illumination sums[PACKETS];
    bool any = false;
    for (uint i = 0; i < PACKETS; i++) {
        const Real3 zero = real3_of(0.0f, 0.0f, 0.0f);
        sums[i] = (Illumination){zero, zero};
        any |= any_lane(lighting[i].wanted);
    }
    for (uint index = 0; CLRT_SHADED && any && index < tracer->frame->light_count; index++)
        add_light(tracer, index, lighting, sums);
    for (uint i = 0; i < PACKETS; i++)
        if (!CLRT_SHADED || !any_lane(lighting[i].wanted))
            colors[i] = lighting[i].material->diffuse;
        else
            colors[i] = shaded_color(tracer, lighting[i].material, &sums[i]);
}

#endif
