// SPDX-License-Identifier: MIT
// Casts shadow rays to a light, and follows the light through glass, which colors it.
#ifndef CLRT_SHADOW_CL
#define CLRT_SHADOW_CL
#include "glass.cl"

// The largest number of surfaces of glass that a shadow ray crosses. A light behind more of them is
// blocked. The limit ends a shadow ray's loop between surfaces that are so close that rounding
// makes them touch.
#define GLASS_CROSSINGS 64

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
