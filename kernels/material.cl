// SPDX-License-Identifier: MIT
// Finds a surface's material. The colors of a checker or of vertices, if the surface has any,
// replace the material's color.
//
// A checker fills the scene with cubes. A cube is odd if the sum of its three indices is odd. The
// part of a surface that shows one cube is a check. A triangle shows the cube on the side away from
// the ray, and a sphere shows the cube inside it. A solid then looks as if it were cut out of a
// block of cubes.
//
// Floors often lie in a plane between cubes, where rounding would choose the cube of each pixel.
// Two rules prevent this (docs/numerics.md, B19):
//  - Each coordinate of the point moves a little behind the surface. On an axis parallel to the
//    surface, no direction leads behind the surface, and the coordinate increases. The edge between
//    two checks of a floor therefore belongs to one of them.
//  - If all corners of a triangle have the same coordinate on an axis, the point gets exactly this
//    coordinate, without rounding.
#ifndef CLRT_MATERIAL_CL
#define CLRT_MATERIAL_CL
#include "surface.cl"

// The point moves behind the surface by CHECK_MOVE * (rate + 1) cubes. rate is the number of cubes
// in a normalized unit.
#define CHECK_MOVE 0x1p-19f

// A surface counts as parallel to an axis if its unit normal has at most this component on the
// axis.
#define CHECK_PARALLEL 0x1p-10f

// The cubes of a material's checker. On each axis, a coordinate has the place rate * coordinate +
// shift, and cube i contains the places from i to i + 1.
typedef struct {
    Real rate; // 0 if the material has no checker
    Real3 shift;
} Cubes;

static inline Cubes fetch_cubes(const Tracer *tracer, UInt material)
{
    const Record record = record_at(tracer->materials, material * WORDS(Material));
    return (Cubes){record_real(&record, 19), record_real3(&record, 20, 1)};
}

static inline Real cube_place(const Cubes *cubes, Real shift, Real coordinate)
{
    return fma(coordinate, cubes->rate, shift);
}

static inline Real place_move(const Cubes *cubes)
{
    return CHECK_MOVE * (cubes->rate + 1.0f);
}

// Returns whether the index of the cube at the place is odd. The subtraction can round only for
// places in [-1, 0). The result is right for these places, too.
static inline Mask place_is_odd(Real place)
{
    const Real pairs = 0.5f * place;
    return pairs - floor(pairs) >= 0.5f;
}

// `face` is a component of the unit normal that points away from the cube.
static inline Mask axis_is_odd(const Cubes *cubes, Real shift, Real coordinate, Real face)
{
    const Real move = place_move(cubes);
    const Real place = cube_place(cubes, shift, coordinate);
    return place_is_odd(place + (face > CHECK_PARALLEL ? -move : move));
}

// Returns the coordinate that all corners share or, if they differ, the point's coordinate.
static inline Real level_coordinate(Real a, Real b, Real c, Real point)
{
    return a == b && b == c ? a : point;
}

static inline Mask check_is_odd(const Cubes *cubes, const Surface *surface)
{
    const Real3 a = surface->a, b = surface->b, c = surface->c, p = surface->point;
    const Real3 shift = cubes->shift;
    const Real3 face = choose3(surface->index == NOTHING, surface->normal, surface->face);
    return axis_is_odd(cubes, shift.x, level_coordinate(a.x, b.x, c.x, p.x), face.x) ^
           axis_is_odd(cubes, shift.y, level_coordinate(a.y, b.y, c.y, p.y), face.y) ^
           axis_is_odd(cubes, shift.z, level_coordinate(a.z, b.z, c.z, p.z), face.z);
}

// Returns the color of the surface's check, or `plain` where the material has no checker.
static inline Real3 checked_color(const Tracer *tracer, const Surface *surface, Real3 plain)
{
    const Cubes cubes = fetch_cubes(tracer, surface->material);
    const Mask has_checks = cubes.rate > 0.0f;
    if (!any_lane(has_checks))
        return plain;
    const Record record = record_at(tracer->materials, surface->material * WORDS(Material));
    const Real3 even = record_real3(&record, 13, 1), odd = record_real3(&record, 16, 1);
    return choose3(has_checks, choose3(check_is_odd(&cubes, surface), odd, even), plain);
}

// Returns the surface's material. Vertex colors replace the colors of checks.
static inline MaterialLanes material_at(const Tracer *tracer, const Surface *surface)
{
    MaterialLanes material = fetch_material(tracer, surface->material);
    if (CLRT_CHECKERS)
        material.diffuse = checked_color(tracer, surface, material.diffuse);
    if (CLRT_COLORS && any_lane(surface->colored))
        material.diffuse = choose3(surface->colored, surface->color, material.diffuse);
    return material;
}

#endif
