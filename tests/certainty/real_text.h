// SPDX-License-Identifier: MIT
// Traces a ray tree without recursion and returns its decisions. real_64.c and real_113.c include
// this file with two number types. Camera rays, and tests of exact numbers alone, have the
// tolerance TOLERANCE, which is over 1000 times the error of a rounding. Each reflection multiplies
// the tolerance by GROWTH. At ordinary shapes, errors grow far less.
#include "certainty/real_hits.h"

#define GROWTH 4096

// The surface at a hit. Normals have any length.
typedef struct {
    Vector point, normal, face;
    Vector corner;                // a corner of the triangle, exactly in the triangle's plane
    const TriangleData *triangle; // NULL for a sphere
    uint32_t id, material;
    bool is_sphere, is_inside;
} Surface;

static Surface sphere_surface(const Path *path, const Stop *stop)
{
    const SphereData *sphere = &path->view->flat->spheres[stop->place];
    const Vector center = center_of(sphere);
    Surface surface = {.point = stepped(path->origin, stop->t, path->direction),
                       .id = stop->id,
                       .material = sphere->material,
                       .is_sphere = true};
    surface.normal = surface.face = minus(surface.point, center);
    surface.is_inside = dot(surface.normal, path->direction) > 0;
    return surface;
}

static Vector weighted(const Vector corners[3], const Stop *stop)
{
    const Vector first = minus(corners[1], corners[0]), second = minus(corners[2], corners[0]);
    return stepped(stepped(corners[0], stop->v, first), stop->w, second);
}

static Surface triangle_surface(const Path *path, const Stop *stop)
{
    const FlatScene *flat = path->view->flat;
    const TriangleData *triangle = &flat->triangles[stop->place];
    const Vector corners[3] = {of_floats(triangle->a), of_floats(triangle->b),
                               of_floats(triangle->c)};
    Surface surface = {.point = weighted(corners, stop),
                       .corner = corners[0],
                       .triangle = triangle,
                       .id = stop->id,
                       .material = triangle->material & ~TRIANGLE_MARKS};
    surface.normal = surface.face =
        cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const uint32_t word = triangle->shading;
    const bool colored = word != NOTHING && (word & TRIANGLE_COLORED) != 0;
    const uint32_t place = colored ? flat->colors[word & ~TRIANGLE_COLORED].shading : word;
    if (place != NOTHING) {
        const CornerNormals *stored = &flat->normals[place];
        const Vector normals[3] = {of_floats(stored->normals[0]), of_floats(stored->normals[1]),
                                   of_floats(stored->normals[2])};
        surface.normal = weighted(normals, stop);
    }
    if (!stop->front) {
        surface.normal = minus(vector(0, 0, 0), surface.normal);
        surface.face = minus(vector(0, 0, 0), surface.face);
    }
    return surface;
}

static void note(RealDecisions *decisions, uint32_t word)
{
    const uint32_t mixed = (decisions->signature ^ word) * 0x9e3779b1u;
    decisions->signature = mixed ^ mixed >> 15;
}

// Returns the sign of value, or 0 if |value| is at most error.
static int clear_sign(NUMBER value, NUMBER error)
{
    return value > error ? 1 : value < -error ? -1 : 0;
}

// Returns 1 if the shading normal faces the light, -1 if not, and 0 if the side is not settled.
static int side_of_normal(const Path *path, const Surface *surface, Vector apart)
{
    const NUMBER error = path->tolerance * extent(surface->normal) *
                         (extent(surface->point) + extent(apart)) * GROWTH;
    return clear_sign(dot(surface->normal, apart), error);
}

// Returns 1 if the light and the path are on the same side of the face, -1 if they are on opposite
// sides, and 0 if the light's side is not settled. For a sphere seen from outside, the result is
// always 1, because side_of_normal alone decides. For a sphere seen from inside, the result is -1,
// because no light is in front of both the face and the normal.
static int side_of_face(const Surface *surface, Vector light)
{
    if (surface->is_sphere)
        return surface->is_inside ? -1 : 1;
    const Vector apart = minus(light, surface->corner);
    const NUMBER error = TOLERANCE * extent(surface->face) * (extent(apart) + extent(light));
    return clear_sign(dot(surface->face, apart), error);
}

// Returns 0 if the surface faces away from the light, 1 if it is lit, 2 if it is in shadow.
static uint32_t see_light(const Path *path, const Surface *surface, const PointLight *light,
                          bool *settled)
{
    const Vector place = of_floats(light->position), apart = minus(place, surface->point);
    const int normal = side_of_normal(path, surface, apart), face = side_of_face(surface, place);
    if (normal < 0 || face < 0)
        return 0;
    *settled = *settled && normal > 0 && face > 0;
    const Path shadow = {.view = path->view,
                         .tolerance = path->tolerance,
                         .origin = surface->point,
                         .direction = apart,
                         .own = surface->id,
                         .own_triangle = surface->triangle};
    const Nearest nearest = meet_all(&shadow, 1);
    const NUMBER high = nearest.stop.t + (nearest.stop.t - nearest.stop.low);
    if (nearest.stop.id != NOTHING && high < 1)
        return 2;
    *settled = *settled && smallest(nearest.other, nearest.stop.low) > 1;
    return 1;
}

static bool see_lights(const Path *path, const Surface *surface, RealDecisions *decisions)
{
    const FlatScene *flat = path->view->flat;
    bool settled = true;
    decisions->lit = 0;
    if (flat->materials[surface->material].shader == SHADER_SILHOUETTE)
        return true;
    for (uint32_t i = 0; i < flat->light_count; i++) {
        const uint32_t seen = see_light(path, surface, &flat->lights[i], &settled);
        note(decisions, seen);
        if (i < 32 && seen == 1)
            decisions->lit |= 1u << i;
    }
    return settled;
}

// A surface's place among the cubes of a checker, along one axis.
typedef struct {
    NUMBER rate, shift;
    NUMBER coordinate, face; // face: component of the unit normal that points away from the cube
    NUMBER tolerance;
} CheckAxis;

// Adds the number of the cube to *sum. Returns whether rounding certainly cannot change the number.
static bool add_cube(const CheckAxis *axis, long long *sum)
{
    const NUMBER move = (axis->rate + 1) / 524288, parallel = (NUMBER)1 / 1024;
    const bool behind = axis->face > parallel;
    const NUMBER place = axis->coordinate * axis->rate + axis->shift + (behind ? -move : move);
    long long cube = (long long)place;
    cube -= (NUMBER)cube > place;
    *sum += cube;
    const NUMBER inside = smallest(place - (NUMBER)cube, (NUMBER)(cube + 1) - place);
    return inside > axis->tolerance * (axis->rate + size_of(place) + 1) &&
           size_of(axis->face - parallel) > axis->tolerance;
}

static NUMBER component_of(Vector v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// Returns the corners' coordinate if all corners share it, otherwise the point's coordinate.
static NUMBER level_coordinate(const Surface *surface, int axis)
{
    const TriangleData *t = surface->triangle;
    const bool is_level = t != NULL && t->a[axis] == t->b[axis] && t->b[axis] == t->c[axis];
    return is_level ? t->a[axis] : component_of(surface->point, axis);
}

// Notes whether a surface with a checker shows an odd cube. Returns whether the cube is settled.
static bool see_check(const Path *path, const Surface *surface, RealDecisions *decisions)
{
    const Material *material = &path->view->flat->materials[surface->material];
    const Vector face = unit(surface->face);
    long long sum = 0;
    bool settled = true;
    if (!(material->check_rate > 0))
        return true;
    for (int i = 0; i < 3; i++) {
        const CheckAxis axis = {material->check_rate, material->check_shift[i],
                                level_coordinate(surface, i), component_of(face, i),
                                path->tolerance * GROWTH};
        settled = add_cube(&axis, &sum) && settled;
    }
    note(decisions, (uint32_t)(sum & 1));
    return settled;
}

// The length of the returned direction is near 1, but not exactly 1.
static Path reflected(const Path *path, const Surface *surface)
{
    const Vector v = minus(vector(0, 0, 0), unit(path->direction)), n = unit(surface->normal);
    const Vector f = unit(surface->face);
    Vector direction = stepped(minus(vector(0, 0, 0), v), 2 * dot(n, v), n);
    const NUMBER height = dot(direction, f);
    if (!surface->is_sphere && height < 0)
        direction = stepped(direction, -2 * height, f);
    return (Path){.view = path->view,
                  .tolerance = path->tolerance * GROWTH,
                  .origin = surface->point,
                  .direction = direction,
                  .own = surface->id,
                  .own_triangle = surface->triangle,
                  .is_own_inside = surface->is_inside};
}

static Path camera_path(const RealView *view, uint32_t column, uint32_t row)
{
    const NUMBER x = 2 * (NUMBER)column + 1 - view->width;
    const NUMBER y = 2 * (NUMBER)row + 1 - view->height;
    const Vector forward = of_floats(view->camera->forward);
    const Vector right = of_floats(view->camera->right_step);
    const Vector down = of_floats(view->camera->down_step);
    const Vector eye = of_floats(view->camera->eye);
    const bool parallel = view->camera->orthographic != 0;
    const Vector moved = stepped(stepped(parallel ? eye : forward, y, down), x, right);
    return (Path){.view = view,
                  .tolerance = TOLERANCE,
                  .origin = parallel ? moved : eye,
                  .direction = parallel ? forward : moved,
                  .own = NOTHING};
}

RealDecisions DECIDE(const RealView *view, uint32_t column, uint32_t row)
{
    RealDecisions decisions = {.settled = true, .first_settled = true, .first_id = NOTHING};
    Path path = camera_path(view, column, row);
    for (uint32_t level = 0; level < view->max_level; level++) {
        RealDecisions here = decisions;
        const Nearest nearest = meet_all(&path, INFINITY);
        bool settled = nearest_is_settled(&nearest);
        note(&here, nearest.stop.id);
        const bool met = nearest.stop.id != NOTHING;
        Surface surface = {0};
        if (met) {
            surface = nearest.stop.id < view->flat->sphere_count
                          ? sphere_surface(&path, &nearest.stop)
                          : triangle_surface(&path, &nearest.stop);
            settled = see_check(&path, &surface, &here) && settled;
            settled = see_lights(&path, &surface, &here) && settled;
        }
        decisions.signature = here.signature;
        decisions.settled = decisions.settled && settled;
        if (level == 0) {
            decisions.first_id = nearest.stop.id;
            decisions.lit = here.lit;
            decisions.first_settled = settled;
        }
        if (!met || !(view->flat->materials[surface.material].reflectivity > 0))
            break;
        path = reflected(&path, &surface);
    }
    return decisions;
}
