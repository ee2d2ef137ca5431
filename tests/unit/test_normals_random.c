// SPDX-License-Identifier: MIT
// Compares computed normals of random meshes with an oracle in long double. The oracle tests all
// pairs of corners, and floods from each corner through the joined pairs.
#include "unit/random.h"
#include "unit/small_mesh.h"

#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

// Returns a mesh with few points, so that faces coincide or oppose each other, and many faces meet
// at an edge. In about half of the meshes, all points are on a grid, so corners are often on a
// line.
static Mesh random_mesh(uint64_t *seed)
{
    static const double scales[] = {1e-30, 1e-12, 1, 1, 1, 1e12, 1e29};
    const double scale = scales[random_below(seed, 7)], jitter = random_below(seed, 2) * 0.3;
    Mesh mesh = new_mesh(4 + random_below(seed, 16), 2 + random_below(seed, 40));
    for (uint32_t vertex = 0; vertex < mesh.vertex_count; vertex++)
        set_vertex(&mesh, vertex, scale * (random_below(seed, 4) + jitter * random_unit(seed)),
                   scale * (random_below(seed, 4) + jitter * random_unit(seed)),
                   scale * (random_below(seed, 3) + jitter * random_unit(seed)));
    for (size_t triangle = 0; triangle < mesh.triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            mesh.triangles[triangle][corner] = random_below(seed, (uint32_t)mesh.vertex_count);
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

// Returns the sum of the weighted face normals of all corners that a flood from `start` reaches.
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

// Compares one corner's normal with the normal of the oracle, unless rounding decides the result.
// The tolerance of 1e-6 covers the rounding of normals to float, and of sums that are not tiny.
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

TEST(random_meshes_agree_with_a_plain_oracle)
{
    size_t judged = 0, corners = 0;
    uint64_t seed = (uint64_t)time(NULL) * 1000003u + (uint64_t)getpid();
    print_message("seed %llu\n", (unsigned long long)seed);
    for (int i = 0; i < 60; i++) {
        FREED_BY(mesh_free) Mesh mesh = random_mesh(&seed);
        FREED_BY(mesh_free) Mesh soup = soup_of(&mesh);
        FREED_BY(mesh_free) Mesh plain = soup_of(&mesh);
        const double crease = i % 10 == 0 ? 0 : i % 10 == 1 ? 180 : 180 * random_unit(&seed);
        Oracle oracle = {&plain, (long double)crease / DEGREES, false};
        compute(&mesh, crease);
        compute(&soup, crease);
        expect_same_normals(&mesh, &soup);
        for (size_t corner = 0; corner < 3 * mesh.triangle_count; corner++)
            judge_corner(&oracle, &mesh, corner, &judged);
        corners += 3 * mesh.triangle_count;
    }
    assert_true(judged > corners / 2);
}
