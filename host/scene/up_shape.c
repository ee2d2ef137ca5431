// SPDX-License-Identifier: MIT
// Tests whether a mesh would stand on a table: whether its center is above the convex hull of the
// points that touch the table. The center is inside the hull if, in every horizontal direction,
// some point that touches lies beyond it.
#include "scene/mesh_load.h"

#define DIRECTIONS 16
// Fractions of the bounding box's longest side.
#define TOUCH  0.01 // points touch the table up to this height
#define MARGIN 0.03 // the hull must reach beyond the center by this distance

typedef struct {
    const Scene *scene;
    double low[3], center[3]; // lowest coordinates; center of the triangles' area
    double extent;            // longest side of the bounding box
} Body;

static const double *corner_of(const Mesh *mesh, size_t triangle, int corner)
{
    return mesh->positions[mesh->triangles[triangle][corner]];
}

// Returns the area relative to the extent's square, so that large coordinates do not overflow.
static double area_of(const Mesh *mesh, size_t triangle, double extent)
{
    double sides[2][3];
    for (int side = 0; side < 2; side++)
        for (int axis = 0; axis < 3; axis++)
            sides[side][axis] =
                (corner_of(mesh, triangle, side + 1)[axis] - corner_of(mesh, triangle, 0)[axis]) /
                extent;
    const Vec3 normal = vec3_cross(vec3(sides[0][0], sides[0][1], sides[0][2]),
                                   vec3(sides[1][0], sides[1][1], sides[1][2]));
    return sqrt(vec3_dot(normal, normal)) / 2;
}

static void find_center(Body *body)
{
    double area = 0;
    for (size_t i = 0; i < body->scene->objects.count; i++) {
        const Mesh *mesh = &body->scene->objects.data[i].mesh;
        for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
            const double part = area_of(mesh, triangle, body->extent);
            for (int corner = 0; corner < 3; corner++)
                for (int axis = 0; axis < 3; axis++)
                    body->center[axis] += part / 3 * corner_of(mesh, triangle, corner)[axis];
            area += part;
        }
    }
    for (int axis = 0; axis < 3; axis++)
        body->center[axis] /= area;
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

// Adds the triangle's corners that touch the table, if at least `least` of them do.
static void add_touching(Hull *hull, const Body *body, const double *corners[3], int up, int least)
{
    const int x = (up + 1) % 3, y = (up + 2) % 3;
    const double table = body->low[up] + TOUCH * body->extent;
    int touching = 0;
    for (int corner = 0; corner < 3; corner++)
        touching += corners[corner][up] <= table;
    for (int corner = 0; touching >= least && corner < 3; corner++)
        if (corners[corner][up] <= table)
            add_to_hull(hull, corners[corner][x] - body->center[x],
                        corners[corner][y] - body->center[y]);
}

// Returns whether the body stands with the axis `up` upward, on triangles of which at least `least`
// corners touch the table.
static bool stands(const Body *body, int up, int least)
{
    Hull hull = empty_hull();
    double reach = INFINITY;
    for (size_t i = 0; i < body->scene->objects.count; i++) {
        const Mesh *mesh = &body->scene->objects.data[i].mesh;
        for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
            const double *corners[3];
            for (int corner = 0; corner < 3; corner++)
                corners[corner] = corner_of(mesh, triangle, corner);
            add_touching(&hull, body, corners, up, least);
        }
    }
    for (int i = 0; i < DIRECTIONS; i++)
        reach = fmin(reach, hull.reach[i]);
    return reach >= MARGIN * body->extent;
}

UpAxis up_axis_of_shape(const Scene *scene)
{
    Body body = {.scene = scene};
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < scene->objects.count; i++)
        mesh_add_bounds(&scene->objects.data[i].mesh, &low, &high);
    body.low[0] = low.x, body.low[1] = low.y, body.low[2] = low.z;
    body.extent = vec3_extent(vec3_sub(high, low));
    find_center(&body);
    return !stands(&body, 2, 1) && stands(&body, 1, 3) ? UP_Y : UP_Z;
}
