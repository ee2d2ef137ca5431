// SPDX-License-Identifier: MIT
// Compares fp64 device functions with closed forms in long double. Distant and huge spheres and
// narrow highlights must be correct to the last bits of double, so float arithmetic would be
// detected.
#include "kernel/probe.h"
#include "unit/cmocka_all.h"

#include <math.h>

// Four units of double's rounding.
#define ROUNDINGS 0x1p-51

#define CASES 4096

static Probe probe;

typedef struct {
    SphereData sphere;
    float ray[6];
    long double exact; // the distance of the hit
} SphereCase;

static void store_center(SphereData *sphere, int axis, double center)
{
    sphere->center[axis] = (float)center;
    sphere->center_low[axis] = (float)(center - (double)sphere->center[axis]);
}

static double largest_error(const SphereCase *cases)
{
    static SphereData spheres[CASES];
    static float rays[CASES][6];
    static double distances[CASES];
    double largest = 0;
    for (int i = 0; i < CASES; i++) {
        spheres[i] = cases[i].sphere;
        for (int k = 0; k < 6; k++)
            rays[i][k] = cases[i].ray[k];
    }
    const ProbeInput inputs[2] = {{spheres, sizeof spheres}, {rays, sizeof rays}};
    assert_true(probe_run(&probe, "probe_spheres", inputs, CASES,
                          (ProbeInput){distances, sizeof distances}));
    for (int i = 0; i < CASES; i++)
        largest = fmax(largest, fabs((double)(distances[i] / cases[i].exact - 1)));
    return largest;
}

// Returns a unit sphere at (3, 4, 0) * distance + (-4, 3, 0) * aside. All numbers are exact, and
// the closed form has no cancellation.
static SphereCase far_case(double distance, double aside)
{
    SphereCase made = {.sphere.radius = 1, .ray = {0, 0, 0, 3, 4, 0}};
    store_center(&made.sphere, 0, 3 * distance - 4 * aside);
    store_center(&made.sphere, 1, 4 * distance + 3 * aside);
    made.exact = distance - sqrtl(1 - 25 * (long double)aside * aside) / 5;
    return made;
}

TEST(far_spheres_are_met_where_they_are)
{
    static SphereCase cases[CASES];
    for (double distance = 0x1p2; distance <= 0x1p22; distance *= 4) {
        for (int i = 0; i < CASES; i++)
            cases[i] = far_case(distance, (i - CASES / 2) * 0x1.98p-14);
        assert_true(largest_error(cases) <= ROUNDINGS);
    }
}

// Returns a sphere that touches the origin from below, and a sloped ray from above that hits it.
static SphereCase ground_case(double radius, float height, float across)
{
    SphereCase made = {.sphere.radius = (float)radius, .ray = {0, 0, height, across, 0, -1}};
    store_center(&made.sphere, 2, -radius);
    const long double h = (long double)height, dd = (long double)across * across + 1;
    const long double b = h + radius, c = h * (h + 2 * radius);
    made.exact = c / (b + sqrtl(b * b - dd * c));
    return made;
}

TEST(ground_spheres_of_any_size_are_met_where_they_are)
{
    static SphereCase cases[CASES];
    for (double radius = 1e3; radius <= 1e9; radius *= 10) {
        for (int i = 0; i < CASES; i++)
            cases[i] = ground_case(radius, 0.25f + (float)(i % 64), (float)(i / 64) * 0.25f);
        assert_true(largest_error(cases) <= ROUNDINGS);
    }
}

// Rounding the argument x changes exp(-x) by x exp(-x) times the rounding. With squaring, each unit
// of the exponent costs a rounding.
TEST(highlights_of_any_shininess_are_right)
{
    static double values[CASES][2], results[CASES][2];
    static const double exponents[] = {1, 3.5, 50, 1000, 1e4, 1e5, 1e6, 1e7};
    for (int i = 0; i < CASES; i++) {
        values[i][1] = exponents[i % 8];
        values[i][0] = exp(-(i / 8) * 0.05 / values[i][1]);
    }
    const ProbeInput inputs[2] = {{values, sizeof values}, {0}};
    assert_true(
        probe_run(&probe, "probe_powers", inputs, CASES, (ProbeInput){results, sizeof results}));
    for (int i = 0; i < CASES; i++) {
        const long double exact = expl(values[i][1] * log1pl(values[i][0] - 1));
        assert_true(fabs((double)(results[i][1] - exact)) <= ROUNDINGS);
        if (values[i][1] <= 1024 && values[i][1] == floor(values[i][1]))
            assert_true(fabs((double)(results[i][0] - exact)) <= (values[i][1] + 1) * 0x1p-53);
    }
}

SET_UP(open_probe)
{
    return probe_begin(&probe, PRECISION_FP64);
}

TEAR_DOWN(close_probe)
{
    probe_close(&probe);
    return 0;
}
