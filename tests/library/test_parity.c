// SPDX-License-Identifier: MIT
// Compares clrt_contains with winding numbers and with exact integers, on ten closed meshes. The
// full run, ctest -C extremes2, has ten million points and a million rays through vertices, through
// edges and along faces.
#include "library/closed_meshes.h"
#include "library/renderer.h"
#include "library/winding.h"
#include "unit/random.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { CHUNK = 100000 };

static ClosedMesh mesh;
static ClrtScene *scene;
static uint64_t numbers = 17;

static double points[CHUNK][3], directions[CHUNK][3];
static uint8_t places[CHUNK], inside[CHUNK];

typedef struct {
    size_t points, on_surface, wrong;
} Tally;

static size_t full_or(size_t full, size_t quick)
{
    const char *tier = getenv("CLRT_TEST_TIER");
    return tier != NULL && atoi(tier) > 1 ? full : quick;
}

static void open_mesh(int number)
{
    mesh = closed_mesh_make(number);
    Position *positions = closed_mesh_positions(&mesh);
    const ClrtMesh given = {.size = sizeof given,
                            .positions = positions[0],
                            .triangles = mesh.faces[0],
                            .vertex_count = mesh.vertex_count,
                            .triangle_count = mesh.face_count};
    scene = clrt_scene_create(NULL);
    assert_true(clrt_scene_add_mesh(scene, &given, NULL));
    free(positions);
}

static void close_mesh(void)
{
    closed_mesh_free(&mesh);
    clrt_scene_free(scene);
}

// Stores a random point, and the direction of a ray from it.
typedef void Aim(double point[3], double direction[3]);

static const int32_t *corner(const uint32_t *face, uint32_t number)
{
    return mesh.vertices[face[number % 3]];
}

static void random_point(double point[3])
{
    for (int axis = 0; axis < 3; axis++)
        point[axis] = random_between(&numbers, -1.05, 1.05);
}

static void aim_at(double point[3], double direction[3], double along)
{
    const uint32_t *face = mesh.faces[random_below(&numbers, (uint32_t)mesh.face_count)];
    const uint32_t first = random_below(&numbers, 3);
    random_point(point);
    for (int axis = 0; axis < 3; axis++) {
        const double a = (double)corner(face, first)[axis] / GRID;
        const double b = (double)corner(face, first + 1)[axis] / GRID;
        direction[axis] = a + along * (b - a) - point[axis];
    }
}

static void aim_at_vertex(double point[3], double direction[3])
{
    aim_at(point, direction, 0);
}

static void aim_at_edge(double point[3], double direction[3])
{
    aim_at(point, direction, random_unit(&numbers));
}

// The ray is on the line of a face's edge, or has another direction in the face's plane.
static void aim_along_face(double point[3], double direction[3])
{
    const uint32_t *face = mesh.faces[random_below(&numbers, (uint32_t)mesh.face_count)];
    const uint32_t first = random_below(&numbers, 3), off_edge = random_below(&numbers, 2);
    const double step = random_between(&numbers, -8, 8), turn = random_unit(&numbers) * off_edge;
    const double aside = random_between(&numbers, -6, 6) * off_edge;
    for (int axis = 0; axis < 3; axis++) {
        const double a = (double)corner(face, first)[axis] / GRID;
        const double b = (double)corner(face, first + 1)[axis] / GRID;
        const double c = (double)corner(face, first + 2)[axis] / GRID;
        direction[axis] = b - a + turn * (c - a);
        point[axis] = a - step * (b - a) + aside * (c - a);
    }
}

static void aim_nowhere(double point[3], double direction[3])
{
    (void)direction;
    random_point(point);
}

static void judge(Tally *tally, size_t count, bool has_directions)
{
    const ClrtRays rays = {.size = sizeof rays,
                           .count = count,
                           .origins = points[0],
                           .directions = has_directions ? directions[0] : NULL};
    assert_true(clrt_contains(renderer, scene, &rays, inside, NULL));
    for (size_t i = 0; i < count; i++) {
        tally->on_surface += places[i] == POINT_ON_SURFACE;
        tally->wrong += places[i] != POINT_ON_SURFACE && inside[i] != (places[i] == POINT_INSIDE);
    }
    tally->points += count;
}

static void report(const char *what, Tally tally)
{
    printf("mesh=%s faces=%zu %s=%zu on_surface=%zu wrong=%zu\n", mesh.name, mesh.face_count, what,
           tally.points, tally.on_surface, tally.wrong);
    fflush(stdout);
    assert_int_equal(tally.wrong, 0);
}

static void judge_aims(const char *what, Aim *aim, size_t count)
{
    Tally tally = {0};
    while (tally.points - tally.on_surface < count) {
        const size_t rest = count - (tally.points - tally.on_surface);
        const size_t part = rest < CHUNK ? rest : CHUNK;
        for (size_t i = 0; i < part; i++)
            aim(points[i], directions[i]);
        winding_places(&mesh, (const double(*)[3])points, part, places);
        judge(&tally, part, aim != aim_nowhere);
    }
    report(what, tally);
}

// Compares random points of the grid, half of them near vertices, with exact arithmetic.
static void judge_exactly(size_t count)
{
    Tally tally = {0};
    for (size_t i = 0; i < count; i++) {
        int32_t point[3];
        const int32_t *near = mesh.vertices[random_below(&numbers, (uint32_t)mesh.vertex_count)];
        const uint32_t spread = i % 2 ? 2 * GRID : 1u << (4 + random_below(&numbers, 15));
        for (int axis = 0; axis < 3; axis++) {
            const int32_t offset = (int32_t)random_below(&numbers, spread) - (int32_t)(spread / 2);
            point[axis] = offset + (i % 2 ? 0 : near[axis]);
            points[i][axis] = (double)point[axis] / GRID;
        }
        places[i] = (uint8_t)exact_place(&mesh, point);
    }
    static uint8_t windings[CHUNK];
    winding_places(&mesh, (const double(*)[3])points, count, windings);
    for (size_t i = 0; i < count; i++) {
        assert_true(windings[i] == POINT_ON_SURFACE || windings[i] == places[i]);
        places[i] = windings[i];
    }
    judge(&tally, count, false);
    report("exact_points", tally);
}

TEST(points_are_inside_where_winding_numbers_say_so)
{
    for (int number = 0; number < CLOSED_MESHES; number++) {
        open_mesh(number);
        judge_aims("points", aim_nowhere, full_or(1000000, 2000));
        judge_exactly(full_or(10000, 500));
        close_mesh();
    }
}

TEST(rays_through_vertices_and_edges_and_along_faces_cross_once)
{
    for (int number = 0; number < CLOSED_MESHES; number++) {
        open_mesh(number);
        judge_aims("vertices", aim_at_vertex, full_or(40000, 1000));
        judge_aims("edges", aim_at_edge, full_or(30000, 1000));
        judge_aims("along_faces", aim_along_face, full_or(30000, 1000));
        close_mesh();
    }
}

// Rays from points of a grid, along axes and diagonals, pass exactly through the cube's edges and
// corners and along its faces.
TEST(rays_through_edges_cross_a_cube_once)
{
    static const double cube[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                      {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
    static const uint32_t sides[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                          {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                          {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    enum { SIDE = 9, POINTS = SIDE * SIDE * SIDE, WAYS = 27 };
    const ClrtMesh given = {.size = sizeof given,
                            .positions = cube[0],
                            .triangles = sides[0],
                            .vertex_count = 8,
                            .triangle_count = 12};
    ClrtScene *box = clrt_scene_create(NULL);
    assert_true(clrt_scene_add_mesh(box, &given, NULL));
    const ClrtRays rays = {
        .size = sizeof rays, .count = POINTS, .origins = points[0], .directions = directions[0]};
    for (int way = 0; way < WAYS; way++) {
        if (way == WAYS / 2) // 0 0 0
            continue;
        for (int i = 0; i < POINTS; i++)
            for (int axis = 0, place = i, turn = way; axis < 3; axis++, place /= SIDE, turn /= 3) {
                points[i][axis] = 0.5 * (place % SIDE - SIDE / 2);
                directions[i][axis] = turn % 3 - 1;
            }
        assert_true(clrt_contains(renderer, box, &rays, inside, NULL));
        for (int i = 0; i < POINTS; i++) {
            const double *at = points[i];
            const double most = fmax(fmax(fabs(at[0]), fabs(at[1])), fabs(at[2]));
            if (most != 1) // on the surface, both results are right
                assert_int_equal(inside[i], most < 1);
        }
    }
    clrt_scene_free(box);
}
