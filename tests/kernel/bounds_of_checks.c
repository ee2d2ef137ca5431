// SPDX-License-Identifier: MIT
// Measures B19 of docs/numerics.md. Each case is a triangle in a plane between two layers of cubes
// or close to such a plane. The corners are off this plane by up to u.
#include "kernel/surface_bounds.h"

#include "scene/normalize.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

typedef struct {
    float hits, coordinate, place, before, beyond, odd_before, odd_beyond;
} Checked;

typedef struct {
    int certain, odd;
} CertainCheck;

// The exact place of a coordinate p is rate * p + shift.
typedef struct {
    Quad rate, shift;
    Quad rounding;   // of the host's fp64
    double layer;    // the exact place of the plane
    bool is_between; // the plane is between two layers
} ExactCheck;

enum { PLACE, PLACE_MOST, LAYER, MOVE, DEVICE, BOUNDS };

static Share shares[BOUNDS] = {
    [PLACE] = {"B19: place, u (|r p| + |s| + |t|)", 0},
    [PLACE_MOST] = {"B19: place, 2 u (r + 1)", 0},
    [LAYER] = {"B19: surface between layers, 15 u (r + 1)", 0},
    [MOVE] = {"B19: place_move, 32 u (r + 1)", 0},
    [DEVICE] = {"B19: moved place, 4 u (|t| + r + 1)", 0},
};

static SurfaceCase cases[CASES];
static TriangleData triangles[CASES];
static Checked checked[CASES];
static CertainCheck certain[CASES][2];
static ExactCheck exact[CASES];
static uint64_t seed = 1901;

// Returns a float within u of v, or v rounded to float if is_rounded is set.
static float stored_near(double v, bool is_rounded)
{
    const float moved = (float)(v + random_between(&seed, -U, U));
    const bool is_usable = fabs(moved - v) <= U && fabsf(moved) <= 1;
    return is_rounded || !is_usable ? (float)v : moved;
}

// Returns the distance of a case's plane from the boundary between two layers, in cubes. If it is
// not 0, the moved coordinate is close to this boundary.
static double offset_of(double rate)
{
    if (random_below(&seed, 3) > 0)
        return 0;
    const double move = (random_below(&seed, 2) == 0 ? 32 : -32) * U * (rate + 1);
    return move + random_between(&seed, -8, 8) * U * (rate + 1);
}

static void make_check(int i)
{
    const uint32_t axis = random_below(&seed, 3);
    const double scale = ldexp(1, (int)random_below(&seed, 40) - 20);
    const int exponent = (int)random_below(&seed, 28) - 16;
    Material material = {.check_size =
                             (float)(ldexp(random_between(&seed, 1, 2), exponent) / scale)};
    const double size = (double)material.check_size, number = random_below(&seed, 1024) - 512.0;
    const double offset = offset_of(1 / (size * scale)), place = (number + offset) * size;
    const double center = place - random_between(&seed, -0.999, 0.999) / scale;
    const Normalization frame = {{center, center, center}, scale};
    normalize_checker(&material, &frame);
    const Quad cubes = (Quad)center / size;
    const double even = 2 * rint((double)(cubes - material.check_shift[0]) / 2);
    exact[i] = (ExactCheck){.rate = 1 / ((Quad)size * scale),
                            .shift = cubes - even,
                            .rounding = 0x1p-53 * magnitude(cubes),
                            .layer = number - even,
                            .is_between = offset == 0};
    surface_case_make(&seed, &cases[i], &triangles[i]);
    const double p = normalize_point(&frame, vec3(place, place, place)).x;
    const bool is_level = random_below(&seed, 4) == 0;
    triangles[i].a[axis] = stored_near(p, is_level);
    triangles[i].b[axis] = stored_near(p, is_level);
    triangles[i].c[axis] = stored_near(p, is_level);
    surface_case_aim(&seed, &cases[i], &triangles[i]);
    cases[i].given[0] = material.check_rate;
    cases[i].given[1] = material.check_shift[0];
    cases[i].given[2] = (float)axis;
}

// Checks that the kernel and the certificate choose the cube that contains the moved place.
static void check_cube(const CertainCheck *answer, float moved, float is_odd)
{
    const bool odd = fmod(floor((double)moved), 2) != 0;
    assert_true(odd == (is_odd != 0));
    assert_true(!answer->certain || odd == (answer->odd != 0));
}

static void check_case(int i)
{
    const Checked *found = &checked[i];
    const Quad r = cases[i].given[0], s = cases[i].given[1], p = found->coordinate;
    const Quad t = exact[i].rate * p + exact[i].shift, stored = r * p + s;
    const Quad move = 32 * U * (r + 1), layer = exact[i].layer;
    if (found->hits == 0)
        return;
    share_note(&shares[PLACE], magnitude(found->place - t),
               (magnitude(r * p) + magnitude(s) + magnitude(t)) * U * (1 + 8 * U) +
                   exact[i].rounding);
    share_note(&shares[PLACE_MOST], magnitude(found->place - t),
               2 * U * (r + 1) * (1 + 8 * U) + exact[i].rounding);
    const Quad most = 4 * U * (magnitude(stored) + r + 1);
    share_note(&shares[DEVICE], magnitude(found->before - (stored - move)), most);
    share_note(&shares[DEVICE], magnitude(found->beyond - (stored + move)), most);
    check_cube(&certain[i][0], found->before, found->odd_before);
    check_cube(&certain[i][1], found->beyond, found->odd_beyond);
    if (!exact[i].is_between)
        return;
    share_note(&shares[LAYER], magnitude(found->place - layer), 15 * U * (r + 1));
    share_note(&shares[MOVE], magnitude(found->before - (layer - move)), move);
    share_note(&shares[MOVE], magnitude(found->beyond - (layer + move)), move);
}

TEST(checks_of_a_surface_between_layers_are_one_layer)
{
    for (int round = 0; round < bound_rounds(); round++) {
        for (int i = 0; i < CASES; i++)
            make_check(i);
        RUN_PROBE(surface_probe, "probe_checks", cases, triangles, checked);
        RUN_PROBE(surface_probe_fp64, "probe_certain_checks", cases, checked, certain);
        for (int i = 0; i < CASES; i++)
            check_case(i);
    }
    shares_check(shares, BOUNDS);
}
