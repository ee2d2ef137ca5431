// SPDX-License-Identifier: MIT
// Follows camera rays through their reflections and refractions (Whitted, "An improved illumination
// model for shaded display", CACM 23(6), 1980). OpenCL C has no recursion. A path therefore keeps
// its color so far and the weight of its next ray, which a recursive tracer would keep on its
// stack.
#ifndef CLRT_TRACE_CL
#define CLRT_TRACE_CL
#include "camera.cl"
#include "shade.cl"

// All Reals from this number on are integers. Adding this number to a smaller Real therefore rounds
// the Real to an integer.
#define LEAST_WHOLE ((Real)(1ul << SIGNIFICAND_BITS))

// Returns a color in steps of 2^-32, rounded to integers. PoCL's rint would take 20 instructions.
static inline Real in_steps(Real color)
{
    const Real steps = clamp_to_one(color) * 0x1p32f;
    return steps < LEAST_WHOLE ? (steps + LEAST_WHOLE) - LEAST_WHOLE : steps;
}

static inline Real3 in_steps3(Real3 color)
{
    return real3_of(in_steps(color.x), in_steps(color.y), in_steps(color.z));
}

// The state of a camera ray's path.
typedef struct {
    Real3 color;   // so far
    Real weight;   // of the next ray's color in the sample's color
    Mask met;      // lanes whose last ray has hit; there, surface and material are valid
    Mask reflects; // lanes with a next ray
    Surface surface;
    MaterialLanes material;
#if CLRT_GLASS
    Real3 tint; // multiplies the weight
    UInt level; // of the last ray; 0 for camera rays
    Real cut;   // sum over the rays that max_level cuts off: weight times tint
#endif
} Path;

#if CLRT_GLASS
#include "branches.cl"
#endif

// The paths of a work-item, which advance in lock step.
typedef struct {
    uint level;        // number of rays that each path has followed
    Ray rays[PACKETS]; // the last rays
    Hit hits[PACKETS]; // the hits of these rays
    Path paths[PACKETS];
#if CLRT_GLASS
    Branches branches[PACKETS];
#endif
} Paths;

static inline void paths_start(Paths *paths, uint number, Ray ray)
{
    paths->level = 0;
    paths->rays[number] = ray;
    Path *path = &paths->paths[number];
    path->color = real3_of(0.0f, 0.0f, 0.0f);
    path->weight = 1.0f;
    path->met = 0;
    path->reflects = ray.active;
#if CLRT_GLASS
    path->tint = real3_of(1.0f, 1.0f, 1.0f);
    path->level = 0;
    path->cut = 0.0f;
    paths->branches[number].waiting = 0;
#endif
}

// Starts the paths of a single packet. The other packets have no rays.
static inline void paths_start_one(Paths *paths, Ray ray)
{
    Ray none = ray;
    none.active = 0;
    for (uint i = 0; i < PACKETS; i++)
        paths_start(paths, i, i == 0 ? ray : none);
}

static inline void count_rays(const Paths *paths, uint number, Tally *tally)
{
    const uint met = lane_count(paths->paths[number].met);
    const uint followed = lane_count(paths->rays[number].active);
    tally->camera_rays += paths->level == 1 ? followed : 0;
    tally->camera_hits += paths->level == 1 ? met : 0;
    tally->reflected_rays += paths->level > 1 ? followed : 0;
    tally->shaded_points += met;
}

// Returns whether any started path has a camera ray to follow.
static inline bool paths_begin(const Tracer *tracer, const Paths *paths)
{
    bool any = false;
    for (uint i = 0; i < PACKETS; i++)
        any |= any_lane(paths->rays[i].active);
    return any && tracer->frame->max_level > 0;
}

#if CLRT_GLASS
static inline bool paths_continue(const Tracer *tracer, Paths *paths)
{
    bool any = false;
    for (uint i = 0; i < PACKETS; i++)
        any |= any_lane(paths->rays[i].active) &&
               follow_branches(tracer, &paths->paths[i], &paths->branches[i], &paths->rays[i]);
    return any;
}

static inline Real3 path_tinted(const Path *path, Real3 color)
{
    return product3(path->tint, color);
}

static inline UInt last_level(const Paths *paths, uint number)
{
    return paths->paths[number].level;
}
#else
// Sets the reflected rays in the lanes of path->reflects. Returns whether any lane has a reflected
// ray.
static inline bool aim_rays(const Tracer *tracer, Paths *paths)
{
    bool any = false;
    for (uint i = 0; i < PACKETS; i++) {
        const Path *path = &paths->paths[i];
        any |= any_lane(path->reflects);
        if (!any_lane(path->reflects))
            paths->rays[i].active = 0;
        else if (CLRT_MIRRORS)
            paths->rays[i] = ray_reflected(tracer, &path->surface, path->reflects);
    }
    return any;
}

// Sets the next rays after paths_step. Returns false if all paths have ended. Loops call this
// function last. On gfx1100, this takes 11 fewer vector registers than calling it first, mostly
// because shading then keeps no old rays.
static inline bool paths_continue(const Tracer *tracer, Paths *paths)
{
    return paths->level < tracer->frame->max_level && aim_rays(tracer, paths);
}

// Returns a color as seen through the glass on the path.
static inline Real3 path_tinted(const Path *path, Real3 color)
{
    (void)path;
    return color;
}

// Returns the level of a packet's last rays.
static inline UInt last_level(const Paths *paths, uint number)
{
    (void)number;
    return (UInt)(paths->level - 1);
}
#endif

// Reads the surfaces that the last rays hit.
static inline void meet_surfaces(const Tracer *tracer, Paths *paths, uint number)
{
    Path *path = &paths->paths[number];
    const Ray *ray = &paths->rays[number];
    const Hit *hit = &paths->hits[number];
    path->met = ray->active && hit->id != NOTHING;
    path->reflects = 0;
    if (CLRT_STATISTICS)
        count_rays(paths, number, tracer->tally);
    if (!any_lane(path->met))
        return;
    path->surface = surface_at(tracer, ray, hit, path->met);
    path->material = material_at(tracer, &path->surface);
    if (CLRT_MIRRORS)
        path->reflects = path->met && path->material.reflectivity != 0.0f;
}

// Follows the active rays up to the surfaces that they hit.
static inline void paths_step(const Tracer *tracer, Paths *paths)
{
    paths->level++;
    nearest_hits(tracer, paths->rays, PACKETS, paths->hits);
    for (uint i = 0; i < PACKETS; i++)
        meet_surfaces(tracer, paths, i);
}

// Returns the weight of the surface's own color in the sample's color.
static inline Real path_share(const Path *path)
{
    const Real rest = path->weight * (1.0f - path->material.reflectivity);
    return path->reflects ? rest : path->weight;
}

static inline void path_add(Path *path, Real3 shaded)
{
    const Real3 color = sum3(path->color, scaled3(path_share(path), path_tinted(path, shaded)));
    const Real reflected = path->reflects ? path->weight * path->material.reflectivity : 0.0f;
    path->color = choose3(path->met, color, path->color);
    path->weight = path->met ? reflected : path->weight;
}

// Adds the surfaces' own colors to the paths. `shaded` receives these colors in lanes whose ray has
// hit a surface.
static inline void paths_shade(const Tracer *tracer, Paths *paths, Real3 shaded[PACKETS])
{
    Lighting lighting[PACKETS];
    for (uint i = 0; i < PACKETS; i++) {
        const Path *path = &paths->paths[i];
        lighting[i] = lighting_of(&path->surface, &path->material, path->met);
    }
    shade(tracer, lighting, shaded);
    for (uint i = 0; i < PACKETS; i++)
        if (any_lane(paths->paths[i].met))
            path_add(&paths->paths[i], shaded[i]);
}

// Returns the color of an ended path. The background gets the remaining weight.
static inline Real3 path_color(const Tracer *tracer, const Path *path)
{
    const Real3 background = load_private3(tracer->frame->background);
    return sum3(path->color, scaled3(path->weight, background));
}

// Traces started paths to their ends, and stores the paths' colors in steps of 2^-32.
static inline void trace(const Tracer *tracer, Paths *paths, Real3 colors[PACKETS])
{
    for (bool any = paths_begin(tracer, paths); any; any = paths_continue(tracer, paths)) {
        paths_step(tracer, paths);
        paths_shade(tracer, paths, colors);
    }
    for (uint i = 0; i < PACKETS; i++)
        colors[i] = in_steps3(path_color(tracer, &paths->paths[i]));
#if CLRT_GLASS
    for (uint i = 0; i < PACKETS; i++)
        count_cut(tracer->tally, paths->paths[i].cut);
#endif
}

#endif
