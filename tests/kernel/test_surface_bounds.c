// SPDX-License-Identifier: MIT
// Continues test_bounds with stored numbers, camera rays, trees over spheres, and the steps after a
// hit: starts of new rays, checks and refraction. The errors are measured in the same way.
#include "kernel/surface_bounds.h"

#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <stdio.h>
#include <stdlib.h>

#define PROBES CLRT_SOURCE_FOLDER "/tests/kernel/surface_bounds.cl"

Probe surface_probe, surface_probe_fp64;

bool share_note(Share *share, Quad error, Quad most)
{
    const double reached = error > 0 ? (double)(error / most) : 0;
    if (reached <= share->share)
        return false;
    share->share = reached;
    return true;
}

void shares_check(const Share *shares, int count)
{
    for (int i = 0; i < count; i++)
        printf("%-51s %.3f\n", shares[i].name, shares[i].share);
    for (int i = 0; i < count; i++)
        assert_true(shares[i].share > 0 && shares[i].share <= 1);
}

int bound_rounds(void)
{
    return getenv("CLRT_TEST_TIER") != NULL ? 600 : 24;
}

void surface_case_aim(uint64_t *seed, SurfaceCase *made, const TriangleData *triangle)
{
    double weights[3], sum = 0;
    for (int k = 0; k < 3; k++) {
        const bool is_small = random_below(seed, 3) == 0;
        weights[k] = ldexp(random_unit(seed), is_small ? -(int)random_below(seed, 30) : 0);
        sum += weights[k];
    }
    for (int axis = 0; axis < 3; axis++) {
        const double target = (weights[0] * triangle->a[axis] + weights[1] * triangle->b[axis] +
                               weights[2] * triangle->c[axis]) /
                              sum;
        made->origin[axis] = (float)random_between(seed, -4, 4);
        made->direction[axis] = (float)(target - made->origin[axis]);
    }
}

void surface_case_make(uint64_t *seed, SurfaceCase *made, TriangleData *triangle)
{
    const double size = ldexp(1, -(int)random_below(seed, 12));
    *triangle = (TriangleData){.shading = UINT32_MAX};
    for (int axis = 0; axis < 3; axis++) {
        const double middle = random_between(seed, size - 1, 1 - size);
        triangle->a[axis] = (float)(middle + random_between(seed, -size, size));
        triangle->b[axis] = (float)(middle + random_between(seed, -size, size));
        triangle->c[axis] = (float)(middle + random_between(seed, -size, size));
    }
    surface_case_aim(seed, made, triangle);
}

SET_UP(open_probes)
{
    return probe_begin(&surface_probe, PROBES, CLRT_FP32) +
           probe_begin(&surface_probe_fp64, PROBES, CLRT_FP64);
}

TEAR_DOWN(close_probes)
{
    probe_close(&surface_probe);
    probe_close(&surface_probe_fp64);
    return 0;
}
