// SPDX-License-Identifier: MIT
// Follows a camera ray through its reflections (Whitted, CACM 23(6) 1980). OpenCL C has no
// recursion, so the loop keeps the weight that a recursive tracer keeps on its stack.
#ifndef CLRT_TRACE_CL
#define CLRT_TRACE_CL
#include "camera.cl"
#include "shade.cl"

// A camera ray's path through its reflections.
typedef struct {
    Ray ray;       // the last ray that was followed
    uint level;    // rays followed
    Real3 color;   // of the path so far
    Real weight;   // of the next ray's color in the sample's color
    Hit hit;       // of the last ray
    Mask met;      // lanes with a hit; the members below are valid there
    Mask reflects; // lanes with a next ray
    Surface surface;
    MaterialLanes material;
} Path;

static inline Path path_along(Ray ray)
{
    return (Path){.ray = ray, .weight = 1.0f, .reflects = ray.active};
}

static inline void count_rays(const Path *path, Tally *tally)
{
    tally->camera_hits += path->level == 1 ? lane_count(path->met) : 0;
    tally->reflected_rays += path->level > 1 ? lane_count(path->ray.active) : 0;
    tally->shaded_points += lane_count(path->met);
}

// Returns the surface's word for signatures. Each sphere is its own surface; all triangles of one
// material are one surface.
static inline UInt surface_word(const FrameData *frame, const Surface *surface)
{
    const UInt of_mesh = frame->sphere_count + surface->material;
    return surface->id < frame->sphere_count ? surface->id : of_mesh;
}

// Follows the next ray of each lane that has one, up to its surface. Returns false if no lane has
// one.
static inline bool path_step(const Tracer *tracer, Path *path)
{
    if (path->level == tracer->frame->max_level || !any_lane(path->reflects))
        return false;
    if (CLRT_MIRRORS && path->level > 0)
        path->ray = ray_reflected(tracer, &path->surface, path->reflects);
    path->level++;
    path->hit = nearest_hit(tracer, &path->ray);
    path->met = path->ray.active && path->hit.id != NOTHING;
    path->reflects = 0;
    if (CLRT_STATISTICS)
        count_rays(path, tracer->tally);
    if (!any_lane(path->met))
        return true;
    path->surface = surface_at(tracer, &path->ray, &path->hit, path->met);
    path->material = fetch_material(tracer, path->surface.material);
    if (CLRT_MIRRORS)
        path->reflects = path->met && path->material.reflectivity != 0.0f;
    sign_lanes(tracer->tally, path->met, surface_word(tracer->frame, &path->surface));
    return true;
}

// Returns the weight of the surface's own color in the sample's color.
static inline Real path_share(const Path *path)
{
    const Real rest = path->weight * (1.0f - path->material.reflectivity);
    return path->reflects ? rest : path->weight;
}

// Adds the surface's own color, and returns it.
static inline Real3 path_shade(const Tracer *tracer, Path *path)
{
    const Lighting lighting = lighting_of(&path->surface, &path->material, path->met);
    const Real3 shaded = shade(tracer, &lighting);
    const Real3 color = sum3(path->color, scaled3(path_share(path), shaded));
    const Real reflected = path->reflects ? path->weight * path->material.reflectivity : 0.0f;
    path->color = choose3(path->met, color, path->color);
    path->weight = path->met ? reflected : path->weight;
    return shaded;
}

// Returns the color of a path that ends: rays without a surface see the background.
static inline Real3 path_color(const Tracer *tracer, const Path *path)
{
    const Real3 background = load_private3(tracer->frame->background);
    return sum3(path->color, scaled3(path->weight, background));
}

static inline Real3 trace(const Tracer *tracer, Ray ray)
{
    Path path = path_along(ray);
    while (path_step(tracer, &path))
        if (any_lane(path.met))
            path_shade(tracer, &path);
    return path_color(tracer, &path);
}

#endif
