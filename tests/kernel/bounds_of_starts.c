// SPDX-License-Identifier: MIT
// Measures B14 of docs/numerics.md: how far the starts of new rays move, and how far from an edge a
// start can be and still move. Also measures the rounding of normals (B13). A case's share is its
// error divided by the bound. After the first round, most cases are changed copies of the cases
// with the largest shares so far.
#include "kernel/surface_bounds.h"

#include "unit/cmocka_all.h"
#include "unit/random.h"

typedef struct {
    float hits, point[3], start[3], direction[3], sine, normal[3];
} Started;

// A triangle in exact numbers.
typedef struct {
    Quad a[3], ab[3], ac[3], normal[3];
    Quad length; // of the normal
    Quad edge;   // bounds the lengths of the edges, as in start_of
} ExactTriangle;

enum { NORMAL, AXIS, SLIDE, NEAR, BOUNDS };

static Share shares[BOUNDS] = {
    [NORMAL] = {"B13: normal, 4 u E + 2 u of its length", 0},
    [AXIS] = {"B14: start on an axis, 256 u / sine + 4 u", 0},
    [SLIDE] = {"B14: start, 450 u / sine + 4 u", 0},
    [NEAR] = {"B14: distance from an edge, 71 u / sine", 0},
};

static SurfaceCase cases[CASES];
static TriangleData triangles[CASES];
static Started started[CASES];
static SurfaceCase worst_cases[BOUNDS];
static TriangleData worst_triangles[BOUNDS];
static uint64_t seed = 1401;

static void note(int i, int bound, Quad error, Quad most)
{
    if (!share_note(&shares[bound], error, most))
        return;
    worst_cases[bound] = cases[i];
    worst_triangles[bound] = triangles[i];
}

// Changes one to four numbers of a case. The corners' coordinates stay in [-1, 1].
static void change(SurfaceCase *changed, TriangleData *triangle)
{
    float *const vectors[6] = {triangle->a,     triangle->b,        triangle->c,
                               changed->origin, changed->direction, changed->given};
    for (uint32_t count = 1 + random_below(&seed, 4); count > 0; count--) {
        const uint32_t vector = random_below(&seed, 6);
        float *const v = &vectors[vector][random_below(&seed, 3)];
        const double by = ldexp(random_between(&seed, -1, 1), -(int)random_below(&seed, 25));
        const float next = (float)((double)*v * (1 + by));
        if (vector >= 3 || fabsf(next) <= 1)
            *v = next;
    }
}

// Makes case i. After the first round, seven of eight cases are changed copies of worst cases. All
// others are random, and their direction is often at a small angle to the triangle.
static void make_start(int i, bool is_first)
{
    const uint32_t worst = random_below(&seed, BOUNDS);
    if (!is_first && i % 8 != 0) {
        cases[i] = worst_cases[worst];
        triangles[i] = worst_triangles[worst];
        change(&cases[i], &triangles[i]);
        return;
    }
    surface_case_make(&seed, &cases[i], &triangles[i]);
    const TriangleData *triangle = &triangles[i];
    const double along = random_between(&seed, -1, 1), across = random_between(&seed, -1, 1);
    const double size = ldexp(1, -(int)random_below(&seed, 20));
    for (int axis = 0; axis < 3; axis++) {
        const double a = (double)triangle->a[axis];
        cases[i].given[axis] =
            (float)(along * ((double)triangle->b[axis] - a) +
                    across * ((double)triangle->c[axis] - a) + random_between(&seed, -size, size));
    }
}

static ExactTriangle exact_triangle(const TriangleData *triangle)
{
    ExactTriangle exact;
    for (int axis = 0; axis < 3; axis++) {
        exact.a[axis] = triangle->a[axis];
        exact.ab[axis] = (Quad)triangle->b[axis] - triangle->a[axis];
        exact.ac[axis] = (Quad)triangle->c[axis] - triangle->a[axis];
    }
    cross3(exact.ab, exact.ac, exact.normal);
    exact.length = length3(exact.normal);
    exact.edge = 2 * (largest3(exact.ab) + largest3(exact.ac));
    return exact;
}

// Returns the least weight of the point's projection, times the area as in start_of.
static Quad room_of(const ExactTriangle *exact, const float point[3])
{
    const Quad from_a[3] = {point[0] - exact->a[0], point[1] - exact->a[1], point[2] - exact->a[2]};
    Quad of_b[3], of_c[3];
    cross3(from_a, exact->ac, of_b);
    cross3(exact->ab, from_a, of_c);
    const Quad square = exact->length * exact->length;
    const Quad b = dot3(of_b, exact->normal) / square, c = dot3(of_c, exact->normal) / square;
    return smaller(smaller(b, c), 1 - b - c) * largest3(exact->normal);
}

// Returns a lower bound of the sine of the new ray's angle to the triangle, as in start_of.
static Quad least_sine(const ExactTriangle *exact, const float direction[3])
{
    const Quad d[3] = {direction[0], direction[1], direction[2]};
    const Quad doubt = 1.02 * 8 * U * largest3(exact->ab) * largest3(exact->ac) / exact->length;
    return magnitude(dot3(d, exact->normal)) / exact->length - doubt - 8 * U;
}

static void check_normal(int i, const ExactTriangle *exact)
{
    const Quad edges = largest3(exact->ab) * largest3(exact->ac);
    for (int axis = 0; axis < 3; axis++)
        note(i, NORMAL, magnitude(started[i].normal[axis] - exact->normal[axis]),
             (4 * edges + 2 * magnitude(exact->normal[axis])) * U * (1 + 8 * U));
}

static void check_case(int i)
{
    const Started *found = &started[i];
    const ExactTriangle exact = exact_triangle(&triangles[i]);
    Quad moved[3];
    check_normal(i, &exact);
    for (int axis = 0; axis < 3; axis++)
        moved[axis] = (Quad)found->start[axis] - found->point[axis];
    const Quad sine = least_sine(&exact, found->direction);
    if (found->hits == 0 || !(sine > 0) || !(largest3(moved) > 0))
        return;
    note(i, AXIS, largest3(moved), 256 * U / (Quad)found->sine + 4 * U);
    note(i, SLIDE, length3(moved), 450 * U / sine + 4 * U);
    const Quad least = smaller(71, 24 + 11 * exact.edge) * U * exact.edge;
    note(i, NEAR, room_of(&exact, found->point) * sine, least);
}

TEST(starts_move_only_near_edges_and_by_a_bounded_distance)
{
    for (int round = 0; round < bound_rounds(); round++) {
        for (int i = 0; i < CASES; i++)
            make_start(i, round == 0);
        RUN_PROBE(surface_probe, "probe_starts", cases, triangles, started);
        for (int i = 0; i < CASES; i++)
            check_case(i);
    }
    shares_check(shares, BOUNDS);
}
