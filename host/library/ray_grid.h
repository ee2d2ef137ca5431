// SPDX-License-Identifier: MIT
// Reads the caller's rays, and orders rays that form rows so that beams trace them faster. Beams
// have at most 64 rays. Programs list the rays of a picture row by row, but 64 rays of a square
// share more nodes than 64 rays of a row. The order changes no bit of the hits.
#pragma once

#include "base/vec.h"
#include "library/clrt.h"

#include <math.h>

// A ray of the caller's arrays.
typedef struct {
    Vec3 origin, direction;
    double near, far;
    uint32_t own;
} GivenRay;

static inline Vec3 given_vector(const double *vectors, size_t stride, size_t index)
{
    const size_t bytes = index * (stride != 0 ? stride : 3 * sizeof(double));
    return vec3_of_doubles((const double *)(const void *)((const char *)vectors + bytes));
}

static inline GivenRay given_ray(const ClrtRays *rays, size_t index)
{
    return (GivenRay){given_vector(rays->origins, rays->origin_stride, index),
                      rays->directions != NULL
                          ? given_vector(rays->directions, rays->direction_stride, index)
                          : vec3(0, 0, 1),
                      rays->nears != NULL ? rays->nears[index] : 0,
                      rays->fars != NULL ? rays->fars[index] : INFINITY,
                      rays->starts != NULL ? rays->starts[index] : CLRT_NOTHING};
}

// Returns the length of the rows if the rays form a grid. In a grid, the points at t = 1 advance in
// one direction and jump back at the end of each row. Returns 0 for other rays.
size_t ray_grid_width(const ClrtRays *rays);

// Fills order with the numbers 0 to count - 1, in blocks of 64 rays of the grid. Rows that fill no
// block come last. If width is 0, the numbers ascend.
void ray_grid_order(uint32_t *order, size_t count, size_t width);
