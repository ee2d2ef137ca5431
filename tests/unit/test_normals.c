// SPDX-License-Identifier: MIT
// Computed normals of shapes whose true normals are known, and of random meshes against an oracle.
// The oracle floods from each corner through all pairs of corners, in long double and with the C
// library's functions.
#include "mesh/mesh.h"

#include "base/array.h"

#include "unit/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define PI      3.14159265358979323846
#define DEGREES (180 / PI)

static Mesh new_mesh(size_t vertices, size_t triangles)
{
    Error error = {0};
    Mesh mesh = {.vertex_count = vertices, .triangle_count = triangles};
    mesh.positions = memory_zeroed(vertices, sizeof *mesh.positions, &error);
    mesh.triangles = memory_zeroed(triangles, sizeof *mesh.triangles, &error);
    assert_true(mesh.positions != NULL && mesh.triangles != NULL);
    return mesh;
}

static void set_vertex(Mesh *mesh, uint32_t vertex, double x, double y, double z)
{
    const double position[3] = {x, y, z};
    memcpy(mesh->positions[vertex], position, sizeof position);
}

static void add_triangle(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t triangle[3] = {a, b, c};
    memcpy(mesh->triangles[mesh->triangle_count++], triangle, sizeof triangle);
}

// Returns the mesh as an STL file has it: no triangles share a vertex.
static Mesh soup_of(const Mesh *mesh)
{
    Mesh soup = new_mesh(3 * mesh->triangle_count, mesh->triangle_count);
    for (uint32_t corner = 0; corner < 3 * mesh->triangle_count; corner++) {
        memcpy(soup.positions[corner], mesh->positions[mesh->triangles[corner / 3][corner % 3]],
               sizeof *soup.positions);
        soup.triangles[corner / 3][corner % 3] = corner;
    }
    return soup;
}

static void compute(Mesh *mesh, double crease_degrees)
{
    Error error = {0};
    if (!mesh_compute_normals(mesh, crease_degrees, &error))
        fail_msg("%s", error.text);
}

static Vec3 normal_at(const Mesh *mesh, size_t triangle, int corner)
{
    const float *n = mesh->normals[mesh->triangles[triangle][corner]];
    return vec3((double)n[0], (double)n[1], (double)n[2]);
}

static Vec3 position_at(const Mesh *mesh, size_t triangle, int corner)
{
    const double *p = mesh->positions[mesh->triangles[triangle][corner]];
    return vec3(p[0], p[1], p[2]);
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

// Returns a body that rings of points around z form, with a point at each end. Its coordinates are
// floats, as those of files.
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

static void a_sphere_of_5000_triangles_is_within_half_a_degree(void **state)
{
    (void)state;
    double rings[35][2];
    for (int ring = 0; ring < 35; ring++) {
        rings[ring][0] = sin(PI * (ring + 1) / 36);
        rings[ring][1] = -cos(PI * (ring + 1) / 36);
    }
    Mesh mesh = revolved((const double(*)[2])rings, 35, 72, -1, 1), soup = soup_of(&mesh);
    assert_int_equal(soup.triangle_count, 5040);
    compute(&soup, CREASE_DEGREES);
    for (size_t triangle = 0; triangle < soup.triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            assert_true(degrees_between(normal_at(&soup, triangle, corner),
                                        position_at(&soup, triangle, corner)) < 0.5);
    mesh_free(&soup);
    mesh_free(&mesh);
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

static void a_cube_stays_sharp(void **state)
{
    (void)state;
    Mesh mesh = cube();
    compute(&mesh, CREASE_DEGREES);
    assert_int_equal(mesh.vertex_count, 24);
    for (size_t triangle = 0; triangle < 12; triangle++)
        for (int corner = 0; corner < 3; corner++) {
            const Vec3 flat = flat_normal(&mesh, triangle);
            const Vec3 normal = normal_at(&mesh, triangle, corner);
            assert_true(normal.x == flat.x && normal.y == flat.y && normal.z == flat.z);
        }
    mesh_free(&mesh);
}

// At the crease angle of 180 degrees, a corner is the mean of three faces of equal angles.
static void a_cube_becomes_round_if_no_edge_is_sharp(void **state)
{
    (void)state;
    Mesh mesh = cube();
    compute(&mesh, 180);
    assert_int_equal(mesh.vertex_count, 8);
    for (size_t triangle = 0; triangle < 12; triangle++)
        for (int corner = 0; corner < 3; corner++) {
            const Vec3 center = {0.5, 0.5, 0.5};
            const Vec3 outward = vec3_sub(position_at(&mesh, triangle, corner), center);
            assert_true(degrees_between(normal_at(&mesh, triangle, corner), outward) < 1e-4);
        }
    mesh_free(&mesh);
}

// 1e-4 degrees cover the rounding of coordinates and normals to float.
static void a_cylinder_is_round_on_its_side_and_sharp_at_its_rims(void **state)
{
    (void)state;
    for (uint32_t sides = 12; sides <= 64; sides++) {
        Mesh mesh = cylinder(sides);
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
        mesh_free(&mesh);
    }
}

static void the_tip_of_a_cone_is_no_dome(void **state)
{
    (void)state;
    static const double rings[1][2] = {{1, 0}};
    Mesh mesh = revolved(rings, 1, 24, 0, 2);
    compute(&mesh, CREASE_DEGREES);
    for (size_t triangle = 0; triangle < mesh.triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            assert_true(degrees_between(normal_at(&mesh, triangle, corner),
                                        flat_normal(&mesh, triangle)) < 7.5);
    mesh_free(&mesh);
}

// The fronts and backs of a tilted square are split along different diagonals, so their sums cancel
// except for rounding.
static void faces_that_cancel_each_other_keep_their_own_normals(void **state)
{
    (void)state;
    Mesh mesh = new_mesh(4, 4);
    mesh.triangle_count = 0;
    for (uint32_t i = 0; i < 4; i++) {
        const double x = i == 1 || i == 2, y = i > 1;
        set_vertex(&mesh, i, x - 0.3 * y, 0.7 * y + 0.1 * x, 0.6 * x + 0.9 * y);
    }
    add_triangle(&mesh, 0, 1, 2);
    add_triangle(&mesh, 0, 2, 3);
    add_triangle(&mesh, 1, 0, 3);
    add_triangle(&mesh, 1, 3, 2);
    compute(&mesh, 180);
    for (size_t triangle = 0; triangle < 4; triangle++)
        for (int corner = 0; corner < 3; corner++)
            assert_true(degrees_between(normal_at(&mesh, triangle, corner),
                                        flat_normal(&mesh, triangle)) < 1e-4);
    mesh_free(&mesh);
}

static void expect_same_normals(const Mesh *a, const Mesh *b)
{
    assert_int_equal(a->triangle_count, b->triangle_count);
    for (size_t triangle = 0; triangle < a->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            assert_memory_equal(a->normals[a->triangles[triangle][corner]],
                                b->normals[b->triangles[triangle][corner]], sizeof *a->normals);
}

static void vertices_at_one_position_are_one_point(void **state)
{
    (void)state;
    Mesh mesh = cylinder(17), soup = soup_of(&mesh);
    soup.positions[0][2] = -0.0;
    compute(&mesh, CREASE_DEGREES);
    compute(&soup, CREASE_DEGREES);
    expect_same_normals(&mesh, &soup);
    mesh_free(&mesh);
    mesh_free(&soup);
}

static void given_normals_are_kept(void **state)
{
    (void)state;
    Error error = {0};
    Mesh mesh = cube(), plain = cube();
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
    mesh_free(&mesh);
    mesh_free(&plain);
}

// Quadratic work at the edge or at the point would take minutes.
static void a_fan_of_many_triangles_takes_no_quadratic_time(void **state)
{
    (void)state;
    const uint32_t count = 300000;
    for (int at_edge = 0; at_edge < 2; at_edge++) {
        Mesh mesh = new_mesh(count + 2, count);
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
        mesh_free(&mesh);
    }
}

static uint64_t seed;

static double chance(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53;
}

static uint32_t choose(uint32_t count)
{
    return (uint32_t)(chance() * count);
}

// Returns a mesh with few points, so that faces coincide, oppose each other and meet at edges in
// any number. Points of a grid are often on a line.
static Mesh random_mesh(void)
{
    static const double scales[] = {1e-30, 1e-12, 1, 1, 1, 1e12, 1e29};
    const double scale = scales[choose(7)], jitter = choose(2) * 0.3;
    Mesh mesh = new_mesh(4 + choose(16), 2 + choose(40));
    for (uint32_t vertex = 0; vertex < mesh.vertex_count; vertex++)
        set_vertex(&mesh, vertex, scale * (choose(4) + jitter * chance()),
                   scale * (choose(4) + jitter * chance()),
                   scale * (choose(3) + jitter * chance()));
    for (size_t triangle = 0; triangle < mesh.triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            mesh.triangles[triangle][corner] = choose((uint32_t)mesh.vertex_count);
    return mesh;
}

typedef struct {
    long double x, y, z;
} Long3;

static Long3 long_between(const Mesh *mesh, size_t triangle, int from, int to)
{
    const Vec3 a = position_at(mesh, triangle, from), b = position_at(mesh, triangle, to);
    const Long3 d = {(long double)b.x - a.x, (long double)b.y - a.y, (long double)b.z - a.z};
    const long double length = sqrtl(d.x * d.x + d.y * d.y + d.z * d.z);
    return length > 0 ? (Long3){d.x / length, d.y / length, d.z / length} : (Long3){0, 0, 0};
}

static Long3 long_cross(Long3 a, Long3 b)
{
    return (Long3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static long double long_dot(Long3 a, Long3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static long double long_angle(Long3 a, Long3 b)
{
    const Long3 cross = long_cross(a, b);
    return atan2l(sqrtl(long_dot(cross, cross)), long_dot(a, b));
}

static Long3 long_unit(Long3 a)
{
    const long double length = sqrtl(long_dot(a, a));
    return (Long3){a.x / length, a.y / length, a.z / length};
}

typedef struct {
    const Mesh *mesh;
    long double crease; // radians
    bool is_close;      // a decision depends on rounding
} Oracle;

static long double long_angle_at(const Oracle *oracle, size_t triangle, int corner)
{
    return long_angle(long_between(oracle->mesh, triangle, corner, (corner + 1) % 3),
                      long_between(oracle->mesh, triangle, corner, (corner + 2) % 3));
}

// Returns whether the face has a normal, and stores it.
static bool long_face(Oracle *oracle, size_t triangle, Long3 *normal)
{
    long double most = 0;
    for (int corner = 0; corner < 3; corner++) {
        const Long3 cross =
            long_cross(long_between(oracle->mesh, triangle, corner, (corner + 1) % 3),
                       long_between(oracle->mesh, triangle, corner, (corner + 2) % 3));
        const long double sine = sqrtl(long_dot(cross, cross));
        if (sine > most)
            *normal = long_unit(cross);
        most = sine > most ? sine : most;
    }
    oracle->is_close |= most > 1e-9L && most < 1e-5L;
    return most > 1e-6L;
}

static bool is_near(Oracle *oracle, Long3 a, Long3 b)
{
    const long double angle = long_angle(a, b);
    const bool is_end = oracle->crease == 0 || oracle->crease > 3.14159L;
    oracle->is_close |= !is_end && fabsl(angle - oracle->crease) < 1e-6L;
    return angle < oracle->crease + 1e-6L;
}

static bool is_at(Vec3 a, Vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool has_side(const Mesh *mesh, size_t triangle, int side, Vec3 a, Vec3 b)
{
    const Vec3 from = position_at(mesh, triangle, side),
               to = position_at(mesh, triangle, (side + 1) % 3);
    return (is_at(from, a) && is_at(to, b)) || (is_at(from, b) && is_at(to, a));
}

static int count_sides(const Mesh *mesh, Vec3 a, Vec3 b)
{
    int count = 0;
    for (size_t side = 0; side < 3 * mesh->triangle_count; side++)
        count += has_side(mesh, side / 3, (int)(side % 3), a, b);
    return count;
}

static bool are_joined(Oracle *oracle, size_t one, size_t other)
{
    const Mesh *mesh = oracle->mesh;
    Long3 normal, other_normal;
    const Vec3 point = position_at(mesh, one / 3, (int)(one % 3));
    if (one / 3 == other / 3 || !is_at(point, position_at(mesh, other / 3, (int)(other % 3))) ||
        !long_face(oracle, one / 3, &normal) || !long_face(oracle, other / 3, &other_normal))
        return false;
    for (size_t step = 1; step < 3; step++) {
        const Vec3 end = position_at(mesh, one / 3, (int)((one % 3 + step) % 3));
        bool is_shared = false;
        for (int side = 0; side < 3; side++)
            is_shared |= has_side(mesh, other / 3, side, point, end);
        if (is_shared && count_sides(mesh, point, end) <= 8 &&
            is_near(oracle, normal, other_normal))
            return true;
    }
    return false;
}

// Stores the sum over all corners that a flood from this one reaches.
static Long3 flood(Oracle *oracle, size_t start)
{
    const size_t count = 3 * oracle->mesh->triangle_count;
    bool is_reached[3 * 64] = {false}, grows = true;
    Long3 sum = {0, 0, 0}, face;
    is_reached[start] = true;
    while (grows) {
        grows = false;
        for (size_t pair = 0; pair < count * count; pair++)
            if (is_reached[pair / count] && !is_reached[pair % count] &&
                are_joined(oracle, pair / count, pair % count))
                grows = is_reached[pair % count] = true;
    }
    for (size_t corner = 0; corner < count; corner++)
        if (is_reached[corner] && long_face(oracle, corner / 3, &face)) {
            const long double angle = long_angle_at(oracle, corner / 3, (int)(corner % 3));
            sum = (Long3){sum.x + angle * face.x, sum.y + angle * face.y, sum.z + angle * face.z};
        }
    return sum;
}

// Compares one corner's normal with the oracle's, unless rounding decides. 1e-6 covers the rounding
// of normals to float, and of sums that are not tiny.
static void judge_corner(Oracle *oracle, const Mesh *mesh, size_t corner, size_t *judged)
{
    Long3 face;
    oracle->is_close = false;
    const Vec3 found = normal_at(mesh, corner / 3, (int)(corner % 3));
    assert_true(isfinite(found.x) && isfinite(found.y) && isfinite(found.z));
    if (!long_face(oracle, corner / 3, &face))
        return;
    const Long3 sum = flood(oracle, corner);
    const long double length = sqrtl(long_dot(sum, sum));
    oracle->is_close |= length > 1e-15L && length < 1e-4L;
    Long3 expected = length > 1e-4L ? long_unit(sum) : face;
    expected = is_near(oracle, expected, face) ? expected : face;
    if (oracle->is_close)
        return;
    ++*judged;
    assert_true(fabsl(expected.x - found.x) < 1e-6L && fabsl(expected.y - found.y) < 1e-6L &&
                fabsl(expected.z - found.z) < 1e-6L);
}

static void random_meshes_agree_with_a_plain_oracle(void **state)
{
    (void)state;
    size_t judged = 0, corners = 0;
    seed = (uint64_t)time(NULL) * 1000003u + (uint64_t)getpid();
    print_message("seed %llu\n", (unsigned long long)seed);
    for (int i = 0; i < 60; i++) {
        Mesh mesh = random_mesh(), soup = soup_of(&mesh);
        const Mesh plain = soup_of(&mesh);
        const double crease = i % 10 == 0 ? 0 : i % 10 == 1 ? 180 : 180 * chance();
        Oracle oracle = {&plain, (long double)crease / DEGREES, false};
        compute(&mesh, crease);
        compute(&soup, crease);
        expect_same_normals(&mesh, &soup);
        for (size_t corner = 0; corner < 3 * mesh.triangle_count; corner++)
            judge_corner(&oracle, &mesh, corner, &judged);
        corners += 3 * mesh.triangle_count;
        mesh_free(&mesh);
        mesh_free(&soup);
        free(plain.positions);
        free(plain.triangles);
    }
    assert_true(judged > corners / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_of_5000_triangles_is_within_half_a_degree),
        cmocka_unit_test(a_cube_stays_sharp),
        cmocka_unit_test(a_cube_becomes_round_if_no_edge_is_sharp),
        cmocka_unit_test(a_cylinder_is_round_on_its_side_and_sharp_at_its_rims),
        cmocka_unit_test(the_tip_of_a_cone_is_no_dome),
        cmocka_unit_test(faces_that_cancel_each_other_keep_their_own_normals),
        cmocka_unit_test(vertices_at_one_position_are_one_point),
        cmocka_unit_test(given_normals_are_kept),
        cmocka_unit_test(a_fan_of_many_triangles_takes_no_quadratic_time),
        cmocka_unit_test(random_meshes_agree_with_a_plain_oracle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
