// SPDX-License-Identifier: MIT
// Refracts rays at glass. docs/numerics.md, "Glass", has the rules.
// Snell's law gives directions. Fresnel's equations for unpolarized light give the reflectance
// (Pharr, Jakob and Humphreys, "Physically based rendering", 4th edition, section 9.5).
//
// The optics use only operations that are correctly rounded on most devices. All of these devices
// compute the same bits.
#ifndef CLRT_GLASS_CL
#define CLRT_GLASS_CL
#include "material.cl"

static inline Mask is_glass(const MaterialLanes *material)
{
    return material->shader == SHADER_GLASS;
}

static inline Real fetch_ior(const Tracer *tracer, UInt material)
{
    const Record record = record_at(tracer->materials, material * WORDS(Material));
    return record_real(&record, 23);
}

// A ray's refraction at a surface.
typedef struct {
    Real ratio;       // the index of refraction on the ray's side, divided by the other index
    Real cosine;      // between the normal and the ray, from 0 to 1
    Real beyond;      // the cosine of the refracted ray; 0 for total reflection
    Real reflectance; // the part of the light that is reflected
} Refraction;

// Returns Fresnel's reflectance, the mean of both polarizations. Equal indices reflect nothing.
// Their case is separate, because the denominators can then be zero.
static inline Real reflectance_of(const Refraction *at)
{
    const Real near = at->ratio * at->cosine, far = at->ratio * at->beyond;
    const Real across = (near - at->beyond) / (near + at->beyond);
    const Real within = (far - at->cosine) / (far + at->cosine);
    const Real mean = 0.5f * (across * across + within * within);
    return at->ratio == 1.0f ? 0.0f : mean;
}

// Returns the refraction of a ray at the given cosine. A negative cosine, from a normal that is
// turned away from the ray, counts as 0. The surface then reflects all light, unless the ratio is
// 1. For the ratio 1, `square` is the rounded square of the cosine, and the root of `square` is the
// cosine itself. The ray then stays straight.
static inline Refraction refraction_at(Real ratio, Real cosine)
{
    Refraction at = {ratio, clamp_to_one(cosine), 0.0f, 1.0f};
    const Real squared = ratio * ratio;
    const Real square = fma(squared * at.cosine, at.cosine, 1.0f - squared);
    const Mask passes = square > 0.0f || ratio == 1.0f;
    at.beyond = sqrt(passes ? square : (Real)(0.0f));
    const Real reflectance = reflectance_of(&at);
    at.reflectance = passes ? reflectance : 1.0f;
    return at;
}

// Returns the direction of the refracted ray, of length 1. The normal is on the ray's side.
static inline Real3 refracted_direction(const Refraction *at, Real3 normal, Real3 toward_viewer)
{
    const Real3 turn = scaled3(at->ratio * at->cosine - at->beyond, normal);
    return difference(turn, scaled3(at->ratio, toward_viewer));
}

// Returns the normal on the ray's side. surface->normal of a sphere always points outward, so the
// result for a sphere is surface->face.
static inline Real3 normal_before(const Surface *surface)
{
    return choose3(surface->index == NOTHING, surface->face, surface->normal);
}

// Returns whether the ray comes from inside: from behind a triangle or from within a sphere.
static inline Mask is_inside(const Tracer *tracer, const Surface *surface, Mask active)
{
    const Mask within = dot_product(surface->face, surface->normal) < 0.0f;
    const Mask on_triangle = active && surface->index != NOTHING;
    if (!CLRT_TRIANGLES || !any_lane(on_triangle))
        return within;
    const Leaving leaving = leaving_from(tracer, surface, on_triangle);
    const UInt index = on_triangle ? surface->index : first_lane(surface->index, on_triangle);
    const Mask behind = leaving.to_front == fetch_reversed(tracer, index);
    return on_triangle ? behind : within;
}

static inline Refraction refraction_of(const Tracer *tracer, const Surface *surface, Mask active)
{
    const Real ior = fetch_ior(tracer, surface->material);
    const Real ratio = is_inside(tracer, surface, active) ? ior : 1.0f / ior;
    return refraction_at(ratio, dot_product(normal_before(surface), surface->toward_viewer));
}

// Returns the surface as seen by rays that leave to the other side.
static inline Surface other_side(const Surface *surface)
{
    Surface other = *surface;
    other.face = negative3(surface->face);
    return other;
}

static inline Ray ray_refracted(const Tracer *tracer, const Surface *surface, const Refraction *at,
                                Mask active)
{
    const Surface beyond = other_side(surface);
    const Real3 normal = normal_before(surface);
    const Real3 direction = refracted_direction(at, normal, surface->toward_viewer);
    return ray_leaving(tracer, &beyond, direction, active);
}

#endif
