// SPDX-License-Identifier: MIT
// Tests whether a mesh would stand on a table: whether its center is above the convex hull of the
// points that touch the table. The center is inside the hull if, in every horizontal direction,
// some point that touches lies beyond it.
#include "scene/mesh_load.h"
#include "scene/triangle_runs.h"

#include <stdlib.h>

#define DIRECTIONS 16
// Fractions of the bounding box's longest side.
#define TOUCH  0.01 // points touch the table up to this height
#define MARGIN 0.03 // the hull must reach beyond the center by this distance

typedef struct {
    TriangleRuns runs;
    Vec3 center;   // of the triangles' area
    double extent; // longest side of the bounding box
} Body;

// Areas are relative to the extent's square, so that large coordinates do not overflow.
static Vec3 center_of(const Body *body)
{
    double area = 0;
    Vec3 center = {0, 0, 0};
    for (size_t i = 0; i < body->runs.runs.count; i++) {
        const TriangleRun *run = &body->runs.runs.data[i];
        for (size_t triangle = run->first; triangle < run->end; triangle++) {
            const Vec3 a = triangle_corner(run->mesh, triangle, 0);
            const Vec3 b = triangle_corner(run->mesh, triangle, 1);
            const Vec3 c = triangle_corner(run->mesh, triangle, 2);
            const Vec3 normal = vec3_cross(vec3_scale(vec3_sub(b, a), 1 / body->extent),
                                           vec3_scale(vec3_sub(c, a), 1 / body->extent));
            const double part = sqrt(vec3_dot(normal, normal));
            center = vec3_add(center, vec3_scale(vec3_add(vec3_add(a, b), c), part / 3));
            area += part;
        }
    }
    return vec3_scale(center, 1 / area);
}

// The hull's reach beyond the body's center in each of the directions x, y.
typedef struct {
    double x[DIRECTIONS], y[DIRECTIONS], reach[DIRECTIONS];
} Hull;

static Hull empty_hull(void)
{
    Hull hull;
    for (int i = 0; i < DIRECTIONS; i++) {
        hull.x[i] = cosine_of_degrees(360.0 / DIRECTIONS * i);
        hull.y[i] = sine_of_degrees(360.0 / DIRECTIONS * i);
        hull.reach[i] = -INFINITY;
    }
    return hull;
}

static void add_to_hull(Hull *hull, double x, double y)
{
    for (int i = 0; i < DIRECTIONS; i++)
        hull->reach[i] = fmax(hull->reach[i], x * hull->x[i] + y * hull->y[i]);
}

// A way to stand: with z up or with y up, on triangles of which at least this many corners touch.
typedef struct {
    bool is_z;
    int least;
} Stance;

// Returns the height of a point. Stores its place on the table in x and y.
static double height_of(const Stance *stance, Vec3 point, double *x, double *y)
{
    *x = point.x;
    *y = stance->is_z ? point.y : point.z;
    return stance->is_z ? point.z : point.y;
}

static void add_touching(Hull *hull, const Body *body, const TriangleRun *run, const Stance *stance)
{
    double x, y, center_x, center_y;
    height_of(stance, body->center, &center_x, &center_y);
    const double table = height_of(stance, body->runs.low, &x, &y) + TOUCH * body->extent;
    if (height_of(stance, run->low, &x, &y) > table)
        return;
    for (size_t triangle = run->first; triangle < run->end; triangle++) {
        int touching = 0;
        for (int corner = 0; corner < 3; corner++)
            touching +=
                height_of(stance, triangle_corner(run->mesh, triangle, corner), &x, &y) <= table;
        for (int corner = 0; touching >= stance->least && corner < 3; corner++)
            if (height_of(stance, triangle_corner(run->mesh, triangle, corner), &x, &y) <= table)
                add_to_hull(hull, x - center_x, y - center_y);
    }
}

static bool stands(const Body *body, const Stance *stance)
{
    Hull hull = empty_hull();
    double reach = INFINITY;
    for (size_t i = 0; i < body->runs.runs.count; i++)
        add_touching(&hull, body, &body->runs.runs.data[i], stance);
    for (int i = 0; i < DIRECTIONS; i++)
        reach = fmin(reach, hull.reach[i]);
    return reach >= MARGIN * body->extent;
}

bool up_axis_of_shape(UpAxis *up, const Scene *scene, Error *error)
{
    static const Stance on_z = {true, 1}, on_flat_y = {false, 3};
    Body body;
    const bool ok = triangle_runs_make(&body.runs, scene, error);
    if (ok) {
        body.extent = vec3_extent(vec3_sub(body.runs.high, body.runs.low));
        body.center = center_of(&body);
        *up = !stands(&body, &on_z) && stands(&body, &on_flat_y) ? UP_Y : UP_Z;
    }
    free(body.runs.runs.memory);
    return ok;
}
