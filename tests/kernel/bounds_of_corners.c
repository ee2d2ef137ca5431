// SPDX-License-Identifier: MIT
// Measures B1 and B16 of docs/numerics.md: the rounding of stored corners, and the height of starts
// over triangles whose corners have equal coordinates on an axis.
#include "kernel/surface_bounds.h"

#include "accel/triangles.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <stdlib.h>

#define POINTS 96

typedef struct {
    float height, threshold, result;
} Height;

static Share stored_share = {"B1: stored coordinate, u", 0};
static Share level_share = {"B16: height of a start, 16 u n.p", 0};

static SurfaceCase cases[CASES];
static TriangleData triangles[CASES];
static Height heights[CASES];
static uint64_t seed = 101;

// Stores a mesh of random points as the host does, and compares the stored with exact coordinates.
static void check_mesh(void)
{
    double positions[POINTS][3];
    uint32_t corners[POINTS / 3][3];
    Error error = {0};
    Scene scene = {0};
    const double size = ldexp(1, (int)random_below(&seed, 40) - 20);
    const double offset = size * ldexp(random_between(&seed, -1, 1), (int)random_below(&seed, 24));
    for (uint32_t i = 0; i < 3 * POINTS; i++) {
        positions[i / 3][i % 3] = offset + random_between(&seed, -size, size);
        corners[i / 9][i / 3 % 3] = i / 3;
    }
    const MeshObject object = {.mesh = {.positions = positions,
                                        .triangles = corners,
                                        .vertex_count = POINTS,
                                        .triangle_count = POINTS / 3}};
    assert_true(array_push(&scene.objects, object, &error));
    const Normalization frame = normalization_of(&scene);
    const double center[3] = {frame.center.x, frame.center.y, frame.center.z};
    FREED_BY(triangles_free) Triangles stored = {0};
    assert_true(triangles_make(&stored, &scene, &frame, NULL, &error));
    for (int i = 0; i < 3 * POINTS; i++) {
        const Quad exact = ((Quad)positions[i / 3][i % 3] - center[i % 3]) * frame.scale;
        const float coordinate = stored.points[i / 3][i % 3];
        assert_true(fabsf(coordinate) <= 1);
        share_note(&stored_share, magnitude(coordinate - exact), U);
    }
    free(scene.objects.memory);
}

TEST(stored_corners_round_within_their_bound)
{
    for (int i = 0; i < 32 * bound_rounds(); i++)
        check_mesh();
    shares_check(&stored_share, 1);
}

// Makes a triangle with the same coordinate at all corners, and a start that is off by at most 15 u
// of its own coordinate. Products underflow in some cases.
static void make_level(int i)
{
    const uint32_t axis = random_below(&seed, 3);
    surface_case_make(&seed, &cases[i], &triangles[i]);
    TriangleData *triangle = &triangles[i];
    const int exponent = random_below(&seed, 4) == 0 ? -(int)random_below(&seed, 120) : 0;
    const float level = ldexpf((float)random_between(&seed, -1, 1), exponent);
    const float start = (float)((double)level * (1 + random_between(&seed, -15, 15) * U));
    const bool is_close = fabs((double)start - level) <= 15 * U * fabs((double)start);
    for (int k = 0; k < 3; k++) {
        const int by = random_below(&seed, 4) == 0 ? exponent : 0;
        triangle->a[k] = ldexpf(triangle->a[k], by);
        triangle->b[k] = ldexpf(triangle->b[k], by);
        triangle->c[k] = ldexpf(triangle->c[k], by);
    }
    triangle->a[axis] = triangle->b[axis] = triangle->c[axis] = level;
    cases[i].origin[axis] = is_close ? start : level;
}

TEST(starts_on_a_level_triangle_are_on_no_side_of_another)
{
    for (int round = 0; round < bound_rounds(); round++) {
        for (int i = 0; i < CASES; i++)
            make_level(i);
        RUN_PROBE(surface_probe, "probe_heights", cases, triangles, heights);
        for (int i = 0; i < CASES; i++) {
            assert_true(heights[i].result == 0);
            if (heights[i].threshold > 0)
                share_note(&level_share, fabsf(heights[i].height), heights[i].threshold);
        }
    }
    shares_check(&level_share, 1);
}
