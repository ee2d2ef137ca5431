// SPDX-License-Identifier: MIT
// Compares computed normals with the true normals of simple shapes.
#include "unit/random.h"
#include "unit/small_mesh.h"

#include <math.h>
#include <time.h>

static void add_triangle(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t triangle[3] = {a, b, c};
    memcpy(mesh->triangles[mesh->triangle_count++], triangle, sizeof triangle);
}

static double degrees_between(Vec3 a, Vec3 b)
{
    const Vec3 cross = vec3_cross(a, b);
    return atan2(sqrt(vec3_dot(cross, cross)), vec3_dot(a, b)) * DEGREES;
}

static Vec3 flat_normal(const Mesh *mesh, size_t triangle)
{
    const Vec3 a = position_at(mesh, triangle, 0);
    return vec3_normalize(vec3_cross(vec3_sub(position_at(mesh, triangle, 1), a),
                                     vec3_sub(position_at(mesh, triangle, 2), a)));
}

// Returns a solid of revolution around z with rings of points, and with a point at each end.
// Coordinates are floats, as in files.
static Mesh revolved(const double (*rings)[2], uint32_t count, uint32_t sides, double low,
                     double high)
{
    Mesh mesh = new_mesh(count * sides + 2, 2 * count * sides);
    mesh.triangle_count = 0;
    for (uint32_t ring = 0; ring < count; ring++)
        for (uint32_t side = 0; side < sides; side++) {
            const double turn = 2 * PI * side / sides;
            set_vertex(&mesh, ring * sides + side, (double)(float)(rings[ring][0] * cos(turn)),
                       (double)(float)(rings[ring][0] * sin(turn)), (double)(float)rings[ring][1]);
        }
    const uint32_t bottom = count * sides, top = bottom + 1;
    set_vertex(&mesh, bottom, 0, 0, low);
    set_vertex(&mesh, top, 0, 0, high);
    for (uint32_t side = 0; side < sides; side++) {
        const uint32_t next = (side + 1) % sides, last = (count - 1) * sides;
        add_triangle(&mesh, bottom, next, side);
        add_triangle(&mesh, top, last + side, last + next);
        for (uint32_t ring = 0; ring + 1 < count; ring++) {
            const uint32_t a = ring * sides + side, b = ring * sides + next;
            add_triangle(&mesh, a, b, b + sides);
            add_triangle(&mesh, a, b + sides, a + sides);
        }
    }
    return mesh;
}

static Mesh cylinder(uint32_t sides)
{
    static const double rings[2][2] = {{1, 0}, {1, 2}};
    return revolved(rings, 2, sides, 0, 2);
}

static Mesh ball(void)
{
    double rings[35][2];
    for (int ring = 0; ring < 35; ring++) {
        rings[ring][0] = sin(PI * (ring + 1) / 36);
        rings[ring][1] = -cos(PI * (ring + 1) / 36);
    }
    return revolved((const double(*)[2])rings, 35, 72, -1, 1);
}

// Colors the corners of each triangle in red, green or blue.
static float (*three_colors(size_t corners))[3]
{
    Error error = {0};
    float(*colors)[3] = memory_zeroed(corners, sizeof *colors, &error);
    assert_non_null(colors);
    for (size_t corner = 0; corner < corners; corner++)
        colors[corner][corner / 3 % 3] = 1;
    return colors;
}

TEST(corners_keep_their_colors_and_share_normals)
{
    FREED_BY(mesh_free) Mesh mesh = ball();
    FREED_BY(mesh_free) Mesh soup = soup_of(&mesh), colored = soup_of(&mesh);
    colored.colors = three_colors(colored.vertex_count);
    compute(&soup, CREASE_DEGREES);
    compute(&colored, CREASE_DEGREES);
    expect_same_normals(&soup, &colored);
    for (size_t triangle = 0; triangle < colored.triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++) {
            const float *color = colored.colors[colored.triangles[triangle][corner]];
            assert_true(color[triangle % 3] == 1 && color[(triangle + 1) % 3] == 0);
        }
}

TEST(a_sphere_of_5000_triangles_is_within_half_a_degree)
{
    FREED_BY(mesh_free) Mesh mesh = ball();
    FREED_BY(mesh_free) Mesh soup = soup_of(&mesh);
    assert_int_equal(soup.triangle_count, 5040);
    compute(&soup, CREASE_DEGREES);
    for (size_t triangle = 0; triangle < soup.triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            assert_true(degrees_between(normal_at(&soup, triangle, corner),
                                        position_at(&soup, triangle, corner)) < 0.5);
}

static Mesh cube(void)
{
    static const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    Mesh mesh = new_mesh(8, 12);
    mesh.triangle_count = 0;
    for (uint32_t i = 0; i < 8; i++)
        set_vertex(&mesh, i, i & 1, i >> 1 & 1, i >> 2);
    for (int face = 0; face < 6; face++) {
        add_triangle(&mesh, faces[face][0], faces[face][1], faces[face][2]);
        add_triangle(&mesh, faces[face][0], faces[face][2], faces[face][3]);
    }
    return mesh;
}

// The tolerance of 1e-4 degrees covers the rounding of coordinates and normals to float.
TEST(a_cylinder_is_round_on_its_side_and_sharp_at_its_rims)
{
    for (uint32_t sides = 12; sides <= 64; sides++) {
        FREED_BY(mesh_free) Mesh mesh = cylinder(sides);
        compute(&mesh, CREASE_DEGREES);
        assert_int_equal(mesh.vertex_count, 4 * sides + 2);
        for (size_t triangle = 0; triangle < mesh.triangle_count; triangle++) {
            const Vec3 flat = flat_normal(&mesh, triangle);
            for (int corner = 0; corner < 3; corner++) {
                const Vec3 p = position_at(&mesh, triangle, corner);
                const Vec3 expected = fabs(flat.z) > 0.5 ? flat : vec3(p.x, p.y, 0);
                assert_true(degrees_between(normal_at(&mesh, triangle, corner), expected) < 1e-4);
            }
        }
    }
}

// Returns a ball of 5040 triangles whose points are moved toward the center by random amounts.
// Larger amounts are rarer.
static Mesh rough_ball(void)
{
    uint64_t random = 7;
    Mesh mesh = ball();
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        const double *p = mesh.positions[i];
        const double scale = 1 + 0.005 * log(1 - random_unit(&random));
        set_vertex(&mesh, i, scale * p[0], scale * p[1], scale * p[2]);
    }
    return mesh;
}

TEST(a_rough_ball_is_smooth_and_a_cylinder_keeps_its_rims_by_shape)
{
    FREED_BY(mesh_free) Mesh rough = rough_ball();
    FREED_BY(mesh_free) Mesh same = rough_ball();
    compute(&rough, CREASE_BY_SHAPE);
    compute(&same, 70);
    expect_same_normals(&rough, &same);
    FREED_BY(mesh_free) Mesh coarse = rough_ball();
    compute(&coarse, CREASE_DEGREES);
    assert_int_not_equal(coarse.vertex_count, rough.vertex_count);
    FREED_BY(mesh_free) Mesh solid = cylinder(600);
    FREED_BY(mesh_free) Mesh sharp = cylinder(600);
    compute(&solid, CREASE_BY_SHAPE);
    compute(&sharp, CREASE_DEGREES);
    expect_same_normals(&solid, &sharp);
}

// Each row sets the number of edges in one window. The other windows are as in a smooth shape.
TEST(each_condition_on_the_angles_decides_the_crease)
{
    static const size_t smooth[ANGLE_WINDOWS] = {500, 300, 200, 150, 100, 60, 40, 30,
                                                 30,  20,  20,  2,   2,   2,  2};
    static const struct {
        int window;
        size_t count;
        double crease;
    } rows[] = {{0, 500, 70}, {3, 400, 33}, {4, 351, 33}, {5, 211, 33}, {7, 49, 70},  {7, 50, 33},
                {10, 49, 70}, {10, 50, 33}, {13, 50, 33}, {14, 33, 70}, {14, 34, 33}, {0, 0, 70}};
    for (size_t row = 0; row < sizeof rows / sizeof rows[0]; row++) {
        EdgeAngles angles = {.edges = 1000};
        memcpy(angles.windows, smooth, sizeof smooth);
        angles.windows[rows[row].window] = rows[row].count;
        if (normals_crease(&angles) != rows[row].crease)
            fail_msg("row %zu: %g", row, normals_crease(&angles));
        angles.edges = 999;
        assert_true(normals_crease(&angles) == CREASE_DEGREES);
    }
    const EdgeAngles empty = {.edges = 5000};
    assert_true(normals_crease(&empty) == CREASE_DEGREES);
}

// The points are integers and lie exactly in a plane, but the triangles' normals are rounded.
TEST(a_plane_of_random_triangles_is_smooth_at_0_degrees)
{
    const uint32_t spokes = 500;
    uint64_t random = 1;
    FREED_BY(mesh_free) Mesh mesh = new_mesh(spokes + 1, spokes);
    mesh.triangle_count = 0;
    set_vertex(&mesh, spokes, 0, 0, 0);
    for (uint32_t i = 0; i < spokes; i++) {
        const double turn = 2 * PI * i / spokes, length = 1e4 * (1 + random_unit(&random));
        const double x = round(length * cos(turn)), y = round(length * sin(turn));
        set_vertex(&mesh, i, x, y, 2 * x - 3 * y);
        add_triangle(&mesh, spokes, i, (i + 1) % spokes);
    }
    compute(&mesh, 0);
    assert_int_equal(mesh.vertex_count, spokes + 1);
}

TEST(given_normals_are_kept)
{
    Error error = {0};
    FREED_BY(mesh_free) Mesh mesh = cube();
    FREED_BY(mesh_free) Mesh plain = cube();
    mesh.normals = memory_zeroed(8, sizeof *mesh.normals, &error);
    assert_non_null(mesh.normals);
    mesh.normals[5][0] = 3;
    compute(&mesh, CREASE_DEGREES);
    compute(&plain, CREASE_DEGREES);
    for (size_t triangle = 0; triangle < 12; triangle++)
        for (int corner = 0; corner < 3; corner++) {
            const Vec3 p = position_at(&mesh, triangle, corner);
            const bool is_given = p.x == 1 && p.y == 0 && p.z == 1;
            const Vec3 normal = normal_at(&mesh, triangle, corner);
            const Vec3 other = normal_at(&plain, triangle, corner);
            const Vec3 expected = is_given ? vec3(3, 0, 0) : other;
            assert_memory_equal(&normal, &expected, sizeof normal);
        }
    const Mesh before = mesh;
    compute(&mesh, CREASE_DEGREES);
    assert_memory_equal(&mesh, &before, sizeof mesh);
}

// All triangles share an edge or a point. Quadratic work at this place would take minutes.
TEST(a_fan_of_many_triangles_takes_no_quadratic_time)
{
    const uint32_t count = 300000;
    for (int at_edge = 0; at_edge < 2; at_edge++) {
        FREED_BY(mesh_free) Mesh mesh = new_mesh(count + 2, count);
        mesh.triangle_count = 0;
        set_vertex(&mesh, count, 0, 0, 1);
        set_vertex(&mesh, count + 1, 0, 0, 0);
        for (uint32_t i = 0; i < count; i++) {
            const double turn = 2 * PI * i / count;
            set_vertex(&mesh, i, cos(turn), sin(turn), 0);
            add_triangle(&mesh, count, i, at_edge != 0 ? count + 1 : (i + 1) % count);
        }
        const clock_t start = clock();
        compute(&mesh, 60);
        assert_true(clock() - start < 10 * CLOCKS_PER_SEC);
    }
}
