// SPDX-License-Identifier: MIT
// A ray of the caller's arrays.
#pragma once

#include "base/vec.h"
#include "library/clrt.h"

#include <math.h>

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
