// SPDX-License-Identifier: MIT
// Refracts rays at glass, and follows light through it. docs/numerics.md, "Glass", has the rules.
// Snell's law gives directions. Fresnel's equations for unpolarized light give the reflectance
// (Pharr, Jakob and Humphreys, "Physically based rendering", 4th edition, section 9.5).
//
// The optics use only operations that are correctly rounded on most devices. All of these devices
// compute the same bits.
#ifndef CLRT_GLASS_CL
#define CLRT_GLASS_CL
#include "material.cl"

// A light behind more surfaces of glass than this is blocked. The limit ends a shadow ray's loop
// between surfaces that are so close that rounding makes them touch.
#define GLASS_CROSSINGS 64

static inline Mask is_glass(const MaterialLanes *material)
{
    return material->shader == SHADER_GLASS;
}

static inline Real fetch_ior(const Tracer *tracer, UInt material)
{
    const Record record = record_at(tracer->materials, material * WORDS(Material));
    return record_real(&record, 23);
}

static inline Real3 product3(Real3 a, Real3 b)
{
    return real3_of(a.x * b.x, a.y * b.y, a.z * b.z);
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

// The results of following shadow rays to a light.
typedef struct {
    Hit blockers[PACKETS]; // primitives that block the light; without glass, any one of several
#if CLRT_GLASS
    Real3 place;          // of the light
    Real3 tints[PACKETS]; // products of the colors of the glass
#endif
} LightPath;

#if CLRT_GLASS
// Returns the shadow ray that continues on the other side of the surface.
static inline Ray ray_onward(const Tracer *tracer, const Surface *surface, Real3 place, Mask active)
{
    const Surface beyond = other_side(surface);
    Heading heading = {place, true};
    const Real3 toward = unit_vector(difference(place, surface->point));
    const Real sine = fabs(dot_product(surface->face, toward));
    const Real3 point = point_left(tracer, &beyond, &heading, sine, active);
    return (Ray){read3(&point), difference(place, point), surface->id, surface->index, RAY_SHADOW,
                 active};
}

// Multiplies the tints of a packet's rays by the color of the glass that the rays hit, and
// continues these rays. Returns whether any ray continues.
static inline bool cross_glass(const Tracer *tracer, Ray *ray, LightPath *light, uint number)
{
    const Mask met = ray->active && light->blockers[number].id != NOTHING;
    ray->active = 0;
    if (!any_lane(met))
        return false;
    Ray before = *ray;
    before.active = met;
    const Surface surface = surface_at(tracer, &before, &light->blockers[number], met);
    const MaterialLanes material = material_at(tracer, &surface);
    const Mask crosses = met && is_glass(&material);
    if (!any_lane(crosses))
        return false;
    const Real3 tint = product3(light->tints[number], material.diffuse);
    light->tints[number] = choose3(crosses, tint, light->tints[number]);
    hash_lanes(tracer->tally, number, crosses, surface_word(tracer->frame, &surface));
    *ray = ray_onward(tracer, &surface, light->place, crosses);
    if (CLRT_STATISTICS)
        tracer->tally->shadow_rays += lane_count(crosses);
    return true;
}

// Follows shadow rays through glass. A ray that has ended keeps its last blocker.
static NOT_INLINE void follow_light(const Tracer *tracer, Ray *rays, uint count, LightPath *light)
{
    Hit found[PACKETS];
    for (uint i = 0; i < count; i++) {
        light->tints[i] = real3_of(1.0f, 1.0f, 1.0f);
        light->blockers[i] = (Hit){1.0f, NOTHING, NOTHING};
    }
    bool any = true;
    for (uint crossing = 0; any && crossing <= GLASS_CROSSINGS; crossing++) {
        blocking_hits(tracer, rays, count, found);
        any = false;
        for (uint i = 0; i < count; i++) {
            const Mask active = rays[i].active;
            Hit *blocker = &light->blockers[i];
            blocker->t = active ? found[i].t : blocker->t;
            blocker->id = active ? found[i].id : blocker->id;
            blocker->index = active ? found[i].index : blocker->index;
            any |= cross_glass(tracer, &rays[i], light, i);
        }
    }
}

// Finds the primitives that block the shadow rays to the light at `place`.
static inline void light_blockers(const Tracer *tracer, Ray *rays, uint count, Real3 place,
                                  LightPath *light)
{
    light->place = place;
    follow_light(tracer, rays, count, light);
}

// Returns a light's color after the glass has tinted it.
static inline Real3 tinted(const LightPath *light, uint number, Real3 color)
{
    return product3(light->tints[number], color);
}
#else
static inline void light_blockers(const Tracer *tracer, Ray *rays, uint count, Real3 place,
                                  LightPath *light)
{
    (void)place;
    blocking_hits(tracer, rays, count, light->blockers);
}

static inline Real3 tinted(const LightPath *light, uint number, Real3 color)
{
    (void)light, (void)number;
    return color;
}
#endif

#endif
