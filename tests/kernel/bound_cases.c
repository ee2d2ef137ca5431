// SPDX-License-Identifier: MIT
// Makes rays and triangles for test_bounds.
#include "kernel/bound_cases.h"

#include "unit/random.h"

#include <math.h>
#include <string.h>

static uint64_t seed = 29;

uint32_t bound_case_choose(uint32_t count)
{
    return random_below(&seed, count);
}

// Returns a random coordinate. A quarter of the coordinates, divided by range, are just above a
// power of two. There, relative rounding errors are largest.
static float coordinate(double range)
{
    const double v = random_between(&seed, -range, range);
    if (random_below(&seed, 4) > 0)
        return (float)v;
    const double steps = random_below(&seed, 64) * 0x1p-23;
    return (float)copysign(ldexp(1 + steps, -(int)random_below(&seed, 6)) * range, v);
}

static void make_triangle(float corners[3][3])
{
    const double size = ldexp(1, -(int)random_below(&seed, 16));
    const double thin = ldexp(1, -(int)random_below(&seed, 24));
    for (int axis = 0; axis < 3; axis++) {
        const float middle = coordinate(1 - size);
        for (int k = 0; k < 2; k++)
            corners[k][axis] = middle + coordinate(size);
        corners[2][axis] =
            random_below(&seed, 3) == 0
                ? corners[0][axis] / 2 + corners[1][axis] / 2 + coordinate(size * thin)
                : middle + coordinate(size);
    }
}

static void make_direction(Line *line, float corners[3][3])
{
    const uint32_t kind = random_below(&seed, 4);
    double weight[3] = {random_unit(&seed), random_unit(&seed), random_unit(&seed)};
    const double sum = weight[0] + weight[1] + weight[2];
    for (int i = 0; i < 3; i++) {
        const double target =
            (weight[0] * corners[0][i] + weight[1] * corners[1][i] + weight[2] * corners[2][i]) /
            sum;
        const double near = ldexp(random_between(&seed, -1, 1), -(int)random_below(&seed, 20));
        line->direction[i] = kind == 0   ? coordinate(1)
                             : kind == 1 ? (float)(1 + near)
                                         : (float)(target - line->origin[i]);
    }
}

// Makes sheared coordinates so small that errors of their products underflow.
static void shrink(Line *line, float corners[3][3])
{
    const uint32_t axis = random_below(&seed, 3);
    const int exponent = -60 - (int)random_below(&seed, 90);
    line->origin[axis] = 0;
    line->direction[axis] = ldexpf(line->direction[axis], exponent);
    for (int k = 0; k < 3; k++)
        corners[k][axis] = ldexpf(corners[k][axis], exponent);
}

void bound_case_make(Line *line, TriangleData *triangle)
{
    float corners[3][3];
    make_triangle(corners);
    const double range = ldexp(1, (int)random_below(&seed, 24) - 12);
    for (int i = 0; i < 3; i++)
        line->origin[i] = random_below(&seed, 3) == 0 ? corners[0][i] + coordinate(range * 0x1p-12)
                                                      : coordinate(range);
    make_direction(line, corners);
    if (random_below(&seed, 8) == 0)
        shrink(line, corners);
    *triangle = (TriangleData){0};
    memcpy(triangle->a, corners[0], sizeof corners[0]);
    memcpy(triangle->b, corners[1], sizeof corners[1]);
    memcpy(triangle->c, corners[2], sizeof corners[2]);
}

static void change(float *value, float most)
{
    const float before = *value;
    const uint32_t kind = random_below(&seed, 4);
    if (kind == 0)
        *value = nextafterf(before, coordinate(2));
    else if (kind == 1)
        *value = (float)(before *
                         (1 + ldexp(random_between(&seed, -1, 1), -(int)random_below(&seed, 24))));
    else if (kind == 2)
        *value =
            (float)(before + ldexp(random_between(&seed, -1, 1), -(int)random_below(&seed, 24)));
    if (!(fabsf(*value) <= most))
        *value = before;
}

void bound_case_change(Line *line, TriangleData *triangle)
{
    float *const corners[3] = {triangle->a, triangle->b, triangle->c};
    for (uint32_t i = 1 + random_below(&seed, 4); i > 0; i--) {
        const uint32_t place = random_below(&seed, 15), axis = place % 3;
        if (place < 6)
            change(place < 3 ? &line->origin[axis] : &line->direction[axis], 0x1p20f);
        else
            change(&corners[place / 3 - 2][axis], 1);
    }
}
