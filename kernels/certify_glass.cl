// SPDX-License-Identifier: MIT
// Bounds the refraction of a ray cone (B20), and keeps the cones of a path that branches. Without
// glass, a path has one cone.
#ifndef CLRT_CERTIFY_GLASS_CL
#define CLRT_CERTIFY_GLASS_CL
#include "certify_surface.cl"

// If the cosine on either side is below LEAST_COSINE, rounding may decide whether there is a
// refracted ray. If the ratio of the indices differs from 1 by less than LEAST_RATIO, rounding may
// decide whether any light is reflected.
#define LEAST_COSINE 0x1p-10f
#define LEAST_RATIO  0x1p-10f

// A path of cones. Slot i contains a waiting cone of level i if bit i of `waiting` is set, as in
// branches.cl.
typedef struct {
    RayCone ray;
    uint level;
    uint waiting;
    RayCone slots[CLRT_GLASS ? GLASS_LEVELS : 1];
} ConePath;

// A refraction with bounds on its errors.
typedef struct {
    bool is_certain;         // if false, rounding may decide which rays leave
    bool refracts, reflects; // total reflection only reflects; a ratio of 1 only refracts
    Real3 direction;         // of the refracted ray
    Real doubt;              // of the direction
} UncertainRefraction;

// Returns whether the ray comes from the inside of the glass.
static inline bool comes_from_inside(const Tracer *tracer, const UncertainSurface *surface)
{
    if (surface->is_sphere)
        return surface->from_behind;
    const bool reversed = (tracer->triangles[surface->index].material & TRIANGLE_REVERSED) != 0;
    return surface->from_behind != reversed;
}

static inline Real squared_cosine_beyond(Real ratio, Real cosine)
{
    return 1.0f - ratio * ratio * (1.0f - cosine) * (1.0f + cosine);
}

static inline UncertainRefraction refract_cone(const Tracer *tracer,
                                               const UncertainSurface *surface, Real u)
{
    const Real ior = fetch_ior(tracer, surface->material);
    const Real ratio = comes_from_inside(tracer, surface) ? ior : 1.0f / ior;
    const bool is_turned = surface->is_sphere && surface->from_behind;
    const Real3 normal = is_turned ? negative3(surface->normal) : surface->normal;
    const Real cosine = dot_product(normal, surface->toward_viewer);
    const Real turn = 1.01f * (surface->normal_doubt + surface->viewer_doubt) + 8.0f * u;
    const Real rounding = 24.0f * u * (1.0f + ratio * ratio);
    const Real low = squared_cosine_beyond(ratio, max(cosine - turn, (Real)(0.0f))) - rounding;
    const Real high = squared_cosine_beyond(ratio, min(cosine + turn, (Real)(1.0f))) + rounding;
    const bool differs = fabs(ratio - 1.0f) > LEAST_RATIO;
    UncertainRefraction at = {.is_certain =
                                  cosine - turn > LEAST_COSINE && (differs || ratio == 1.0f),
                              .refracts = low > LEAST_COSINE * LEAST_COSINE,
                              .reflects = differs};
    if (!at.is_certain || !at.refracts) {
        at.is_certain = at.is_certain && high < 0.0f;
        return at;
    }
    const Real beyond = sqrt(squared_cosine_beyond(ratio, min(cosine, (Real)(1.0f))));
    const Real least = sqrt(low), growth = ratio * (cosine + turn) / least;
    at.direction = difference(scaled3(ratio * cosine - beyond, normal),
                              scaled3(ratio, surface->toward_viewer));
    at.doubt = 1.02f * (max((Real)(1.0f), growth) * surface->normal_doubt +
                        max(ratio, growth) * surface->viewer_doubt) +
               (24.0f * ratio + 8.0f) * u + rounding / least;
    return at;
}

static inline RayCone refracted_cone(const UncertainSurface *surface, const UncertainRefraction *at,
                                     Real u)
{
    UncertainSurface beyond = *surface;
    beyond.face = negative3(surface->face);
    return leaving_cone(&beyond, at->direction, at->doubt, u);
}

// Takes the deepest waiting cone. Returns false if none waits.
static inline bool pop_cone(ConePath *path)
{
    if (path->waiting == 0)
        return false;
    path->level = 31 - clz(path->waiting);
    path->ray = path->slots[path->level];
    path->waiting ^= 1u << path->level;
    return true;
}

// Sets the next ray at a surface of glass. If the path splits, the reflected ray waits, unless
// max_level cuts it off. Returns false if it is uncertain which rays leave.
static inline bool decide_refraction(const Tracer *tracer, const UncertainSurface *surface,
                                     ConePath *path)
{
    const Real u = path->ray.u + OWN_ROUNDOFF;
    const UncertainRefraction at = refract_cone(tracer, surface, u);
    const RayCone reflected = reflected_cone(surface, &path->ray);
    const uint level = path->level + 1;
    if (!at.is_certain)
        return false;
    path->ray = at.refracts ? refracted_cone(surface, &at, path->ray.u) : reflected;
    if (at.refracts && at.reflects && level < tracer->frame->max_level) {
        path->slots[level] = reflected;
        path->waiting |= 1u << level;
    }
    return true;
}

#endif
