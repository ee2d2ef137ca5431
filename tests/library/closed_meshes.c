// SPDX-License-Identifier: MIT
// Globes and tubes are grids of vertices. Other meshes are the surfaces of voxels.
#include "library/closed_meshes.h"

#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#define TURN 6.283185307179586

typedef struct {
    double x, y, z;
} Point;

static void *require(void *memory)
{
    assert_non_null(memory);
    return memory;
}

static ClosedMesh mesh_of(const char *name, size_t vertices, size_t faces)
{
    return (ClosedMesh){.name = name,
                        .vertices = require(calloc(vertices, sizeof(int32_t[3]))),
                        .faces = require(calloc(faces, sizeof(uint32_t[3]))),
                        .vertex_count = vertices};
}

void closed_mesh_free(ClosedMesh *mesh)
{
    free(mesh->vertices);
    free(mesh->faces);
}

Position *closed_mesh_positions(const ClosedMesh *mesh)
{
    Position *positions = require(calloc(mesh->vertex_count, sizeof *positions));
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            positions[i][axis] = (double)mesh->vertices[i][axis] / GRID;
    return positions;
}

static void place(ClosedMesh *mesh, size_t vertex, Point point)
{
    mesh->vertices[vertex][0] = (int32_t)lrint(point.x * GRID);
    mesh->vertices[vertex][1] = (int32_t)lrint(point.y * GRID);
    mesh->vertices[vertex][2] = (int32_t)lrint(point.z * GRID);
}

static void add_face(ClosedMesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *face = mesh->faces[mesh->face_count++];
    face[0] = a;
    face[1] = b;
    face[2] = c;
}

static void add_quad(ClosedMesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    add_face(mesh, a, b, c);
    add_face(mesh, a, c, d);
}

enum { ROWS = 12, COLUMNS = 24, GLOBE_VERTICES = ROWS * COLUMNS + 2 };

// Adds the faces of a globe, which has rows of vertices between two poles.
static void add_globe(ClosedMesh *mesh, uint32_t first)
{
    const uint32_t poles = first + ROWS * COLUMNS;
    for (uint32_t column = 0; column < COLUMNS; column++) {
        const uint32_t next = (column + 1) % COLUMNS, last = first + (ROWS - 1) * COLUMNS;
        for (uint32_t row = 0; row + 1 < ROWS; row++) {
            const uint32_t here = first + row * COLUMNS, above = here + COLUMNS;
            add_quad(mesh, here + column, here + next, above + next, above + column);
        }
        add_face(mesh, first + next, first + column, poles);
        add_face(mesh, last + column, last + next, poles + 1);
    }
}

// Returns the direction of a globe's vertex. The last two vertices are the poles.
static Point globe_direction(uint32_t vertex)
{
    const double up = (vertex / COLUMNS + 0.5) * TURN / 2 / ROWS;
    const double around = vertex % COLUMNS * TURN / COLUMNS;
    if (vertex >= ROWS * COLUMNS)
        return (Point){0, 0, vertex == ROWS * COLUMNS ? -1 : 1};
    return (Point){sin(up) * cos(around), sin(up) * sin(around), -cos(up)};
}

typedef double Radius(Point direction, uint64_t *random);

static double radius_sphere(Point direction, uint64_t *random)
{
    (void)direction, (void)random;
    return 1;
}

static double radius_bumpy(Point direction, uint64_t *random)
{
    (void)random;
    return 0.75 + 0.25 * sin(7 * direction.x) * sin(9 * direction.z);
}

static double radius_star(Point direction, uint64_t *random)
{
    (void)direction;
    return random_between(random, 0.1, 1);
}

static ClosedMesh globe(const char *name, Radius *radius, Point size)
{
    uint64_t random = 5;
    ClosedMesh mesh = mesh_of(name, GLOBE_VERTICES, (size_t)2 * ROWS * COLUMNS);
    for (uint32_t vertex = 0; vertex < GLOBE_VERTICES; vertex++) {
        const Point direction = globe_direction(vertex);
        const double r = radius(direction, &random);
        place(
            &mesh, vertex,
            (Point){r * size.x * direction.x, r * size.y * direction.y, r * size.z * direction.z});
    }
    add_globe(&mesh, 0);
    return mesh;
}

// Returns a hollow ball: a globe with a smaller globe inside.
static ClosedMesh shells(void)
{
    ClosedMesh mesh = mesh_of("shells", (size_t)2 * GLOBE_VERTICES, (size_t)4 * ROWS * COLUMNS);
    for (uint32_t vertex = 0; vertex < GLOBE_VERTICES; vertex++) {
        const Point at = globe_direction(vertex);
        place(&mesh, vertex, at);
        place(&mesh, vertex + GLOBE_VERTICES, (Point){-0.6 * at.x, 0.6 * at.y, 0.6 * at.z});
    }
    add_globe(&mesh, 0);
    add_globe(&mesh, GLOBE_VERTICES);
    return mesh;
}

// A closed curve, as a function of a number in [0, 1).
typedef Point Curve(double t);

static Point curve_circle(double t)
{
    return (Point){0.7 * cos(TURN * t), 0.7 * sin(TURN * t), 0};
}

// A trefoil knot, which is far from convex.
static Point curve_knot(double t)
{
    const double a = TURN * t;
    return (Point){0.28 * (sin(a) + 2 * sin(2 * a)), 0.28 * (cos(a) - 2 * cos(2 * a)),
                   -0.4 * sin(3 * a)};
}

static Point minus(Point a, Point b)
{
    return (Point){a.x - b.x, a.y - b.y, a.z - b.z};
}

static Point cross(Point a, Point b)
{
    return (Point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static Point unit(Point a)
{
    const double length = sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    return (Point){a.x / length, a.y / length, a.z / length};
}

static ClosedMesh tube(const char *name, Curve *curve, double radius)
{
    enum { RINGS = 60, SIDES = 6 };
    ClosedMesh mesh = mesh_of(name, RINGS * SIDES, (size_t)2 * RINGS * SIDES);
    for (uint32_t ring = 0; ring < RINGS; ring++) {
        const double t = (double)ring / RINGS;
        const Point at = curve(t), along = unit(minus(curve(t + 1e-4), curve(t - 1e-4)));
        const Point aside = unit(cross(along, (Point){0.1, 0.2, 1})), up = cross(aside, along);
        for (uint32_t side = 0; side < SIDES; side++) {
            const double x = radius * cos(TURN * side / SIDES),
                         y = radius * sin(TURN * side / SIDES);
            const uint32_t next = (side + 1) % SIDES, after = (ring + 1) % RINGS;
            place(&mesh, ring * SIDES + side,
                  (Point){at.x + x * aside.x + y * up.x, at.y + x * aside.y + y * up.y,
                          at.z + x * aside.z + y * up.z});
            add_quad(&mesh, ring * SIDES + side, ring * SIDES + next, after * SIDES + next,
                     after * SIDES + side);
        }
    }
    return mesh;
}

enum { VOXELS = 6, POINTS = VOXELS + 1 };
typedef bool Voxel(int x, int y, int z);

static bool voxel_comb(int x, int y, int z)
{
    (void)y;
    return z == 0 || x % 2 == 0;
}

static bool voxel_random(int x, int y, int z)
{
    return (uint32_t)(x * 7919 + y * 104729 + z * 1299709) * 2654435761u >> 31 != 0;
}

static bool is_full(Voxel *voxel, const int at[3])
{
    for (int axis = 0; axis < 3; axis++)
        if (at[axis] < 0 || at[axis] >= VOXELS)
            return false;
    return voxel(at[0], at[1], at[2]);
}

static uint32_t voxel_corner(const int at[3])
{
    return (uint32_t)((at[2] * POINTS + at[1]) * POINTS + at[0]);
}

// Adds one of the two sides of the voxel `at` that are perpendicular to the axis. If end is 1, this
// is the side with the larger coordinate.
static void add_side(ClosedMesh *mesh, const int at[3], int axis, int end)
{
    int corners[4][3];
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    for (int i = 0; i < 4; i++) {
        corners[i][axis] = at[axis] + end;
        corners[i][x] = at[x] + ((i == 1 || i == 2) ? 1 : 0);
        corners[i][y] = at[y] + (i >= 2 ? 1 : 0);
    }
    add_quad(mesh, voxel_corner(corners[0]), voxel_corner(corners[end ? 1 : 3]),
             voxel_corner(corners[2]), voxel_corner(corners[end ? 3 : 1]));
}

static ClosedMesh voxels(const char *name, Voxel *voxel)
{
    ClosedMesh mesh =
        mesh_of(name, POINTS * POINTS * POINTS, (size_t)12 * VOXELS * VOXELS * VOXELS);
    for (uint32_t i = 0; i < POINTS * POINTS * POINTS; i++)
        place(&mesh, i,
              (Point){i % POINTS * 2.0 / VOXELS - 1, i / POINTS % POINTS * 2.0 / VOXELS - 1,
                      i / (POINTS * POINTS) * 2.0 / VOXELS - 1});
    for (int i = 0; i < VOXELS * VOXELS * VOXELS; i++)
        for (int side = 0; side < 6; side++) {
            const int at[3] = {i % VOXELS, i / VOXELS % VOXELS, i / (VOXELS * VOXELS)};
            int beside[3] = {at[0], at[1], at[2]};
            beside[side / 2] += side % 2 ? 1 : -1;
            if (is_full(voxel, at) && !is_full(voxel, beside))
                add_side(&mesh, at, side / 2, side % 2);
        }
    return mesh;
}

ClosedMesh closed_mesh_make(int number)
{
    switch (number) {
    case 0:
        return globe("sphere", radius_sphere, (Point){1, 1, 1});
    case CLOSED_BUMPY:
        return globe("bumpy", radius_bumpy, (Point){1, 1, 1});
    case 2:
        return globe("star", radius_star, (Point){1, 1, 1});
    case 3:
        return globe("disk", radius_sphere, (Point){1, 1, 0.01});
    case 4:
        return globe("needle", radius_sphere, (Point){0.01, 0.01, 1});
    case 5:
        return shells();
    case 6:
        return tube("torus", curve_circle, 0.25);
    case 7:
        return tube("knot", curve_knot, 0.1);
    case 8:
        return voxels("comb", voxel_comb);
    default:
        return voxels("voxels", voxel_random);
    }
}
