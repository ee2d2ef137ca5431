// SPDX-License-Identifier: MIT
// The kernel of --aov certainty. A tracer makes decisions: which primitive a ray hits first, which
// check (square of a checker) the hit shows, and which lights reach the hit. The kernel repeats the
// decisions of each pixel's ray tree with ray cones, which contain the exact ray and the tracer's
// rounded ray (certify_cone.cl). A decision is certain if it holds for the whole cone.
//
// A pixel is certified if all its decisions are certain for the fp32 tracer. If they are certain
// only for the fp64 tracer, the pixel is repaired: it gets the color of the fp64 tracer. All other
// pixels are open. Only programs with this kernel contain this file. In them, the file follows
// render.cl, and CLRT_FP64 is set.
//
// Invariant: an answer of YES or NO is proved. If a bound does not suffice, the answer is UNKNOWN.
// All decisions that depend on this answer are then uncertain.
#include "certify_glass.cl"

// The decisions so far, all of them certain. A tracer in real arithmetic makes the same decisions.
typedef struct {
    uint first_id, lit, signature; // as in CertaintyMark
} Decisions;

static inline void hash_decision(Decisions *decisions, uint word)
{
    const uint mixed = (decisions->signature ^ word) * 0x9e3779b1u;
    decisions->signature = mixed ^ mixed >> 15;
}

// A surface's coordinate and normal on one axis, with bounds on their errors.
typedef struct {
    Real coordinate, doubt;
    Real face, face_doubt; // component of the unit normal that points away from the cube
} AxisPlace;

// Returns the surface's place on an axis. The coordinate is exact if all corners of the triangle
// share it, as in material.cl.
static inline AxisPlace axis_place(const UncertainSurface *surface, uint axis)
{
    const Corners *corners = &surface->corners;
    const Real a = component(corners->a, axis), b = component(corners->b, axis);
    const bool is_level = !surface->is_sphere && a == b && b == component(corners->c, axis);
    return (AxisPlace){is_level ? a : component(surface->end.point, axis),
                       is_level ? 0.0f : radius_of(&surface->end), component(surface->face, axis),
                       surface->is_sphere ? surface->normal_doubt : surface->face_doubt};
}

// Returns whether the index of the point's cube on the axis is certain (B19). Toggles *odd if the
// index is odd.
static inline bool decide_axis(const Cubes *cubes, Real shift, const AxisPlace *at, Real u,
                               uint *odd)
{
    const Real place = cube_place(cubes, shift, at->coordinate), move = place_move(cubes);
    const Real rounding = 4.0f * (u + OWN_ROUNDOFF) * (fabs(place) + cubes->rate + 1.0f);
    const Real error = cubes->rate * at->doubt + rounding;
    const Real low = place + (at->face > CHECK_PARALLEL - at->face_doubt ? -move : move) - error;
    const Real high = place + (at->face > CHECK_PARALLEL + at->face_doubt ? -move : move) + error;
    *odd ^= place_is_odd(low) ? 1 : 0;
    return floor(low) == floor(high);
}

// Decides which check the surface shows. Returns false if the check is not certain.
static inline bool decide_check(const Tracer *tracer, const UncertainSurface *surface, Real u,
                                Decisions *decisions)
{
    const Cubes cubes = fetch_cubes(tracer, surface->material);
    const AxisPlace x = axis_place(surface, 0), y = axis_place(surface, 1);
    const AxisPlace z = axis_place(surface, 2);
    uint odd = 0;
    if (!(cubes.rate > 0.0f))
        return true;
    const bool is_certain = decide_axis(&cubes, cubes.shift.x, &x, u, &odd) &&
                            decide_axis(&cubes, cubes.shift.y, &y, u, &odd) &&
                            decide_axis(&cubes, cubes.shift.z, &z, u, &odd);
    hash_decision(decisions, odd);
    return is_certain;
}

// A surface's relation to a light: turned away, lit, in shadow, or undecided.
typedef enum { SIGHT_BEHIND, SIGHT_CLEAR, SIGHT_BLOCKED, SIGHT_OPEN } LightVisibility;

// Sets the shadow ray that continues behind glass. Returns false if the glass shows a check that is
// not certain.
static inline bool cross_glass_surface(const Tracer *tracer, const UncertainSurface *surface,
                                       RayCone *ray, Decisions *decisions)
{
    hash_decision(decisions, surface->id);
    if (CLRT_CHECKERS && !decide_check(tracer, surface, ray->u, decisions))
        return false;
    *ray = shadow_cone(surface, ray->goal.point, ray->u);
    return true;
}

// Follows a shadow ray to its light, as follow_light (shadow.cl) does.
static inline LightVisibility certify_path(const Tracer *tracer, RayCone ray, Decisions *decisions)
{
    for (uint crossing = 0; crossing <= GLASS_CROSSINGS && is_usable(&ray); crossing++) {
        const ConeSearch search = search_blockers(tracer, &ray);
        if (!search.may_meet_glass && search.blocked == ANSWER_UNKNOWN)
            return SIGHT_OPEN;
        if (!search.may_meet_glass)
            return search.blocked == ANSWER_YES ? SIGHT_BLOCKED : SIGHT_CLEAR;
        if (!nearest_is_certain(&search.nearest))
            return SIGHT_OPEN;
        const UncertainSurface surface = uncertain_surface(tracer, &ray, &search.nearest);
        const MaterialLanes material = fetch_material(tracer, surface.material);
        if (!is_glass(&material))
            return SIGHT_BLOCKED;
        if (!cross_glass_surface(tracer, &surface, &ray, decisions))
            return SIGHT_OPEN;
    }
    return SIGHT_OPEN;
}

static inline LightVisibility certify_light(const Tracer *tracer, const UncertainSurface *surface,
                                            const RayCone *to_light, Decisions *decisions)
{
    const Answer faces = certify_facing(surface, to_light);
    if (faces == ANSWER_NO)
        return SIGHT_BEHIND;
    return faces == ANSWER_YES ? certify_path(tracer, *to_light, decisions) : SIGHT_OPEN;
}

// Decides which lights reach the surface. Returns false if a decision is not certain.
static inline bool decide_lights(const Tracer *tracer, const UncertainSurface *surface, Real u,
                                 Decisions *decisions)
{
    uint lit = 0;
    for (uint index = 0; index < tracer->frame->light_count; index++) {
        const Real3 light = load3(tracer->lights[index].position);
        const RayCone ray = shadow_cone(surface, light, u);
        const LightVisibility visibility = certify_light(tracer, surface, &ray, decisions);
        if (visibility == SIGHT_OPEN)
            return false;
        hash_decision(decisions, visibility);
        if (index < 32 && visibility == SIGHT_CLEAR)
            lit |= 1u << index;
    }
    decisions->lit = lit;
    return true;
}

// Makes the decisions at the end of the path's ray, and sets the next ray. Stores in *leads whether
// there is a next ray. Returns false if a decision is not certain.
static inline bool decide_ray(const Tracer *tracer, ConePath *path, Decisions *decisions,
                              bool *leads)
{
    *leads = false;
    if (!is_usable(&path->ray))
        return false;
    const Nearest nearest = certify_nearest_hit(tracer, &path->ray);
    if (!nearest_is_certain(&nearest))
        return false;
    hash_decision(decisions, nearest.id);
    if (nearest.id == NOTHING)
        return true;
    const UncertainSurface surface = uncertain_surface(tracer, &path->ray, &nearest);
    if (CLRT_CHECKERS && !decide_check(tracer, &surface, path->ray.u, decisions))
        return false;
    const MaterialLanes material = fetch_material(tracer, surface.material);
    Decisions here = {nearest.id, 0, decisions->signature};
    if (IS_SHADED(material.shader) && !decide_lights(tracer, &surface, path->ray.u, &here))
        return false;
    *decisions =
        path->level == 0 ? here : (Decisions){decisions->first_id, decisions->lit, here.signature};
    *leads = material.reflectivity != 0.0f;
    if (CLRT_GLASS && is_glass(&material))
        return decide_refraction(tracer, &surface, path);
    if (*leads)
        path->ray = reflected_cone(&surface, &path->ray);
    return true;
}

// Makes the decisions of a sample's ray tree. Returns false if a decision is not certain.
static inline bool decide(const Tracer *tracer, uint2 sample, Real u, Decisions *decisions)
{
    ConePath path;
    path.ray = camera_cone(tracer->frame, sample, u);
    path.level = path.waiting = 0;
    *decisions = (Decisions){NOTHING, 0, 0};
    for (bool leads = true; leads || pop_cone(&path); path.level++) {
        if (path.level >= tracer->frame->max_level)
            leads = false;
        else if (!decide_ray(tracer, &path, decisions, &leads))
            return false;
    }
    return true;
}

// Returns the certainty of the pixel's least certain sample. Stores the decisions of the last
// examined sample in *decisions.
static inline Certainty decide_pixel(const Tracer *tracer, uint2 pixel, Decisions *decisions)
{
    const uint side = tracer->frame->samples;
    Certainty certainty = CERTAINTY_CERTIFIED;
    for (uint sample = 0; sample < side * side; sample++) {
        const uint2 place = pixel * side + (uint2)(sample % side, sample / side);
        if (decide(tracer, place, 0x1p-24f, decisions))
            continue;
        certainty = CERTAINTY_REPAIRED;
        if (!decide(tracer, place, 0x1p-53f, decisions))
            return CERTAINTY_OPEN;
    }
    return certainty;
}

// Stores one mark per pixel of the tile in `marks`, and the colors of repaired pixels in `pixels`.
// The range of work-items is padded to whole work-groups.
kernel void certify_tile(TRACER_ARGUMENTS, global float *pixels, global CertaintyMark *marks)
{
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    const uint column = (uint)get_global_id(0), row = (uint)get_global_id(1);
    if (column >= frame.tile_width || row >= frame.tile_height)
        return;
    const size_t place = (size_t)row * frame.tile_width + column;
    const uint2 pixel = (uint2)(frame.tile_x + column, frame.tile_y + row);
    Decisions decisions;
    const Certainty certainty = decide_pixel(&tracer, pixel, &decisions);
    marks[place] =
        (CertaintyMark){certainty, decisions.first_id, decisions.lit, decisions.signature};
    if (certainty != CERTAINTY_REPAIRED)
        return;
    const Places places = {pixel.x, pixel.y, true};
    Real3 color;
    pixel_colors(&tracer, &places, &color);
    store_lane(pixels + 3 * place, &color, 0);
}
