// SPDX-License-Identifier: MIT
// Difficult sets of triangles for the tests of builders, in normalized coordinates.
#pragma once

#include "accel/triangles.h"
#include "unit/random.h"

#include <assert.h>
#include <stdlib.h>

typedef enum { SET_SCATTERED, SET_EQUAL, SET_CONCENTRIC, SET_SPIRAL, SET_KINDS } TriangleSet;

static inline Triangles triangle_set(TriangleSet set, size_t count)
{
    Triangles triangles = {.points = malloc((3 * count + 1) * sizeof *triangles.points),
                           .corners = malloc((count + 1) * sizeof *triangles.corners),
                           .count = count,
                           .point_count = 3 * count};
    assert(triangles.points != NULL && triangles.corners != NULL);
    uint64_t state = 1;
    float size = 1;
    for (size_t i = 0; i < count; i++) {
        const float corner = set == SET_CONCENTRIC ? (float)(i + 1) / (float)count : 0.01f;
        const float center = set == SET_SPIRAL ? size : 0;
        for (int k = 0; k < 3; k++) {
            float *point = triangles.points[3 * i + (size_t)k];
            triangles.corners[i][k] = (uint32_t)(3 * i) + (uint32_t)k;
            point[3] = 0;
            for (int axis = 0; axis < 3; axis++) {
                const float at = axis == k ? corner : -0.5f * corner;
                point[axis] = set == SET_SCATTERED ? (float)random_between(&state, -1, 1)
                                                   : center + at * size;
            }
        }
        if (set == SET_SPIRAL && i < 100)
            size *= 0.5f;
    }
    return triangles;
}
