// SPDX-License-Identifier: MIT
// Measures the errors that docs/numerics.md bounds, by comparison with numbers of 113 bits. The
// errors of these numbers are below 2^-60 of any bound. Prints for each bound the largest error
// divided by the bound. No quotient may exceed 1. The search starts with random rays, and then
// varies the rays with the largest errors. With CLRT_TEST_TIER, the search is longer.
#include "kernel/bound_cases.h"
#include "kernel/bound_math.h"
#include "kernel/probe.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CASES 4096

typedef struct {
    float sheared[3][3], edges[3], contains, t, error, tie, behind, near_high, near_low, point[3];
    float height, doubt, point_height, point_doubt, height_over, point_height_over, inverse_z;
    float inverse[3], near_offset[3], far_offset[3];
    float unit[3], discriminant, apart, power, along;
} Traced;

typedef struct {
    double margin, behind, blur, size, low, high;
} Certified;

typedef enum {
    SHEAR,
    SHEAR_LARGEST,
    EDGE,
    DEPTH,
    DEPTH_ERROR,
    DISTANCE_ERROR,
    TIE,
    NEARNESS,
    HEIGHT,
    POINT_HEIGHT,
    POINT_BLUR,
    CULL,
    SLAB,
    BLUR,
    CERTIFIED_DEPTH,
    MARGIN,
    BEHIND,
    UNIT,
    SPHERE_PASSED,
    SPHERE_SIDE,
    SPHERE_AWAY,
    DISCRIMINANT,
    BOUNDS
} Bound;

static const char *const names[BOUNDS] = {
    "B2: corners, 4 u |s z| + 2 u |x|",
    "B2: corners, 6 u Q",
    "B3: edge functions, 2 u",
    "B4: depth, 14 u Z",
    "B4: triangle_depth_error, 18 u (Z + X)",
    "B4: distance, 54 u (o + 1) / |d|",
    "B4: tie, 128 u (o + 1) / |d|",
    "B5: nearness, 2^-43",
    "B6: height over a plane, 8 u (n.a + E a)",
    "B7: height of a surface point, 8 u n.p + 3 u n.m",
    "B7: POINT_BLUR",
    "B8: box of a hit, 22 u Q",
    "B9: slabs, u (2 B + 4 O)",
    "B10: blur, 4.01 u w z + 10 u l",
    "B11: certified depth, 25 u",
    "B12: margin_of, 70 u",
    "B12: behind_of, 448 u",
    "B13: unit vector, 4.5 u",
    "B15: sphere_is_passed, 16 u",
    "B15: plain_side, 16 u",
    "B15: leads_away, 8 u",
    "B15: discriminant, 64 u^2",
};

#define PROBES CLRT_SOURCE_FOLDER "/tests/kernel/bounds.cl"

static Probe probe, probe_fp64;
static Line lines[CASES], worst_lines[BOUNDS];
static TriangleData triangles[CASES], worst_triangles[BOUNDS];
static Traced traced[CASES];
static Certified certified[CASES];
static double shares[BOUNDS];

static void make_cases(bool first)
{
    for (int i = 0; i < CASES; i++) {
        const uint32_t bound = bound_case_choose(BOUNDS);
        if (first || i % 8 == 0) {
            bound_case_make(&lines[i], &triangles[i]);
            continue;
        }
        lines[i] = worst_lines[bound];
        triangles[i] = worst_triangles[bound];
        bound_case_change(&lines[i], &triangles[i]);
    }
}

// Skips tiny bounds, because underflow adds errors of up to a few 2^-149.
static void note(int i, Bound bound, Quad error, Quad most)
{
    if (most < 0x1p-100)
        return;
    const double share = error > 0 ? (double)(error / most) : 0;
    if (!(share > shares[bound]))
        return;
    shares[bound] = share;
    worst_lines[bound] = lines[i];
    worst_triangles[bound] = triangles[i];
}

// A case in exact numbers. As in the kernels' shear, the axis of the direction's largest component
// is the last in `axes`.
typedef struct {
    int axes[3];
    Quad origin[3], direction[3], length;
    Quad corners[3][3];  // as stored
    Quad relative[3][3]; // to the origin, in the order of the axes
    Quad far;            // Q, the largest component of a relative corner
    Quad depth;          // Z, the largest depth of a corner
} Exact;

static Exact exact_case(int number)
{
    const Line *line = &lines[number];
    const float *const corners[3] = {triangles[number].a, triangles[number].b, triangles[number].c};
    const float x = fabsf(line->direction[0]), y = fabsf(line->direction[1]);
    const int z = fabsf(line->direction[2]) > fmaxf(x, y) ? 2 : y > x;
    Exact exact = {.axes = {(z + 1) % 3, (z + 2) % 3, z}};
    for (int i = 0; i < 3; i++) {
        exact.origin[i] = line->origin[i];
        exact.direction[i] = line->direction[i];
        for (int k = 0; k < 3; k++)
            exact.corners[k][i] = corners[k][i];
    }
    exact.length = quad_root(dot3(exact.direction, exact.direction));
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++)
            exact.relative[k][i] = exact.corners[k][exact.axes[i]] - exact.origin[exact.axes[i]];
        exact.far = larger(exact.far, largest3(exact.relative[k]));
        exact.depth = larger(exact.depth, magnitude(exact.relative[k][2]));
    }
    return exact;
}

static void check_corners(int i, const Exact *exact)
{
    Quad most = 0;
    for (int k = 0; k < 3; k++) {
        Quad shift[3] = {0}, along = 0;
        for (int axis = 0; axis < 2; axis++) {
            const Quad s = exact->direction[exact->axes[axis]] / exact->direction[exact->axes[2]];
            const Quad z = exact->relative[k][2], x = exact->relative[k][axis] - s * z;
            shift[axis] = traced[i].sheared[k][axis] - x;
            note(i, SHEAR, magnitude(shift[axis]),
                 (4 * magnitude(s * z) + 2 * magnitude(x)) * U * (1 + 8 * U));
            note(i, SHEAR_LARGEST, magnitude(shift[axis]), 6 * U * exact->far);
            along += shift[axis] * exact->direction[exact->axes[axis]] / exact->length;
        }
        most = larger(most, quad_root(dot3(shift, shift) - along * along));
    }
    note(i, BLUR, most, certified[i].blur);
}

// Stores the edge functions of the rounded corners in `edges`. Returns false if the error of a
// product may underflow. Even then, no edge function of the kernel may have the opposite sign.
static bool check_edges(int i, Quad edges[3])
{
    float(*s)[3] = traced[i].sheared;
    bool is_normal = true;
    for (int k = 0; k < 3; k++) {
        const float *p = s[(k + 2) % 3], *q = s[(k + 1) % 3];
        const Quad one = (Quad)p[0] * q[1], other = (Quad)p[1] * q[0];
        edges[k] = one - other;
        assert_true(traced[i].edges[k] == 0 || (traced[i].edges[k] > 0) == (edges[k] > 0));
        if ((one != 0 && magnitude(one) < 0x1p-100) || (other != 0 && magnitude(other) < 0x1p-100))
            is_normal = false;
        else
            note(i, EDGE, magnitude(traced[i].edges[k] - edges[k]), 2 * U * magnitude(edges[k]));
    }
    return is_normal;
}

static void check_distance(int i, const Exact *exact, const Quad weights[3], Quad sum)
{
    const Traced *found = &traced[i];
    const Quad d = magnitude(exact->direction[exact->axes[2]]), far = largest3(exact->origin);
    Quad z = 0, rounded = 0;
    for (int k = 0; k < 3; k++) {
        z += weights[k] * exact->relative[k][2];
        rounded += weights[k] * found->sheared[k][2];
    }
    const Quad distance = z / exact->direction[exact->axes[2]];
    const Quad error = magnitude(found->t - distance);
    note(i, DEPTH, error, 14 * U * exact->depth / d * (1 + 16 * U));
    note(i, DEPTH_ERROR, error, found->error);
    note(i, TIE, 2 * error, found->tie);
    // For smaller edge functions, the low parts of sums of two floats underflow.
    if (magnitude(sum) * exact->depth > 0x1p-90)
        note(i, NEARNESS,
             magnitude((Quad)found->near_high + found->near_low - rounded * found->inverse_z),
             0x1p-43 * exact->depth / d);
    note(i, CERTIFIED_DEPTH, error * exact->length, 25 * U * certified[i].size);
    const Quad way = found->t * exact->length;
    assert_true(certified[i].low <= way && way <= certified[i].high);
    for (int axis = 0; axis < 3; axis++) {
        const Quad hit = exact->origin[axis] + found->t * exact->direction[axis];
        Quad low = exact->corners[0][axis], high = low;
        for (int k = 1; k < 3; k++) {
            low = low < exact->corners[k][axis] ? low : exact->corners[k][axis];
            high = larger(high, exact->corners[k][axis]);
        }
        note(i, CULL, larger(low - hit, hit - high), 22 * U * exact->far);
    }
    note(i, DISTANCE_ERROR, found->error, 54 * U * (far + 1) / d * (1 + 16 * U));
}

static void check_heights(int i, const Exact *exact, const Quad weights[3], bool hits)
{
    const Traced *found = &traced[i];
    Quad ab[3], ac[3], apart[3], normal[3], to_point[3], most = 0;
    for (int k = 0; k < 3; k++) {
        ab[k] = exact->corners[1][k] - exact->corners[0][k];
        ac[k] = exact->corners[2][k] - exact->corners[0][k];
        apart[k] = exact->origin[k] - exact->corners[0][k];
        to_point[k] = found->point[k] - exact->corners[0][k];
    }
    cross3(ab, ac, normal);
    const Quad height = dot3(normal, apart);
    note(i, HEIGHT, magnitude(found->height - height), found->doubt);
    assert_true(found->height_over == 0 || (found->height_over > 0) == (height > 0));
    if (!hits)
        return;
    for (int k = 0; k < 3; k++) {
        Quad size = 0;
        for (int corner = 0; corner < 3; corner++)
            size += weights[corner] * magnitude(exact->corners[corner][k]);
        most += magnitude(normal[k]) * (8 * magnitude(found->point[k]) + 3 * size) * U;
    }
    const Quad above = magnitude(dot3(normal, to_point));
    note(i, POINT_HEIGHT, above, most * (1 + 32 * U));
    note(i, POINT_BLUR, above, found->point_doubt);
}

static void check_slabs(int i, const Exact *exact)
{
    const Traced *found = &traced[i];
    const Quad widest = largest3(exact->origin), longest = largest3(exact->direction);
    for (int axis = 0; axis < 3; axis++)
        for (int k = 0; k < 6; k++) {
            const Quad d = exact->direction[axis];
            const float plane = (float)exact->corners[k % 3][axis];
            const float offset = k < 3 ? found->near_offset[axis] : found->far_offset[axis];
            const Quad slack = 0x1p-16 * widest * ((k < 3) == !signbit((double)d) ? 1 : -1);
            if (magnitude(d) < 0x1p-30 * longest)
                continue;
            const Quad way = fmaf(plane, found->inverse[axis], offset) * d;
            note(i, SLAB, magnitude(way - (plane - (exact->origin[axis] + slack))),
                 U * (2 * magnitude(plane) + 4 * widest) * (1 + 0x1p-15));
        }
}

static void check_unit(int i, const Exact *exact)
{
    Quad error[3];
    for (int axis = 0; axis < 3; axis++)
        error[axis] = traced[i].unit[axis] - exact->direction[axis] / exact->length;
    note(i, UNIT, quad_root(dot3(error, error)), 4.5 * U * (1 + 16 * U));
}

static void check_sphere(int i, const Exact *exact)
{
    const TriangleData *triangle = &triangles[i];
    const float r = fabsf(triangle->c[0]);
    const Quad radius = (Quad)r + r * (0x1p-25f * triangle->b[0]);
    Quad center[3], f[3], foot[3];
    for (int k = 0; k < 3; k++) {
        center[k] = (Quad)triangle->a[k] + triangle->a[k] * (0x1p-25f * triangle->b[k]);
        f[k] = exact->origin[k] - center[k];
    }
    const Quad along = dot3(f, exact->direction) / (exact->length * exact->length);
    for (int k = 0; k < 3; k++)
        foot[k] = f[k] - along * exact->direction[k];
    const Quad squared = dot3(foot, foot), apart = quad_root(dot3(f, f));
    const Quad of_center = quad_root(dot3(center, center));
    const Quad squares = dot3(exact->origin, exact->origin) + of_center * of_center;
    note(i, SPHERE_PASSED, magnitude(traced[i].apart - (squared - radius * radius)),
         16 * U * (squares + radius * radius));
    note(i, SPHERE_SIDE, magnitude(traced[i].power - (dot3(f, f) - radius * radius)),
         16 * U * (squares + radius * radius));
    note(i, SPHERE_AWAY, magnitude(traced[i].along - dot3(f, exact->direction)),
         8 * U * quad_root(squares) * exact->length);
    note(i, DISCRIMINANT, magnitude(traced[i].discriminant - (radius * radius - squared)),
         64 * U * U * (quad_root(squared) + radius) * (apart + radius + of_center) +
             64 * U * U * U * apart * apart + 2 * U * magnitude(radius * radius - squared));
}

static void check_case(int i)
{
    Quad edges[3];
    const Exact exact = exact_case(i);
    if (!(largest3(exact.direction) >= 0x1p-40))
        return;
    check_corners(i, &exact);
    check_slabs(i, &exact);
    check_unit(i, &exact);
    check_sphere(i, &exact);
    note(i, MARGIN, traced[i].error * exact.length, certified[i].margin);
    note(i, BEHIND, traced[i].behind * exact.length, certified[i].behind);
    const bool hits = check_edges(i, edges) && traced[i].contains > 0;
    const Quad sum = edges[0] + edges[1] + edges[2];
    const Quad weights[3] = {edges[0] / sum, edges[1] / sum, edges[2] / sum};
    check_heights(i, &exact, weights, hits);
    if (hits)
        check_distance(i, &exact, weights, sum);
}

TEST(no_rounding_error_exceeds_its_bound)
{
    const ProbeInput inputs[2] = {{lines, sizeof lines}, {triangles, sizeof triangles}};
    const int rounds = getenv("CLRT_TEST_TIER") != NULL ? 600 : 64;
    for (int round = 0; round < rounds; round++) {
        make_cases(round == 0);
        assert_true(
            probe_run(&probe, "probe_bounds", inputs, CASES, (ProbeInput){traced, sizeof traced}));
        assert_true(probe_run(&probe_fp64, "probe_margins", inputs, CASES,
                              (ProbeInput){certified, sizeof certified}));
        for (int i = 0; i < CASES; i++)
            check_case(i);
    }
    for (int bound = 0; bound < BOUNDS; bound++)
        printf("%-51s %.3f\n", names[bound], shares[bound]);
    for (int bound = 0; bound < BOUNDS; bound++)
        assert_true(shares[bound] <= 1);
}

SET_UP(open_probes)
{
    return probe_begin(&probe, PROBES, CLRT_FP32) + probe_begin(&probe_fp64, PROBES, CLRT_FP64);
}

TEAR_DOWN(close_probes)
{
    probe_close(&probe);
    probe_close(&probe_fp64);
    return 0;
}
