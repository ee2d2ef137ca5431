// SPDX-License-Identifier: MIT
// Finds whether points are inside closed meshes, by winding numbers and by exact integers.
#pragma once

#include "library/closed_meshes.h"

#include <stdbool.h>

typedef enum {
    POINT_OUTSIDE,
    POINT_INSIDE,
    POINT_ON_SURFACE // within rounding, or exactly
} PointPlace;

// Stores the PointPlace of each point, by winding numbers modulo 2. A point that is near a
// triangle, and within 2^-21 of its plane, counts as on the surface.
void winding_places(const ClosedMesh *mesh, const double (*points)[3], size_t count,
                    uint8_t *places);

// Returns the place of a point in units of 1 / GRID, by exact determinants.
PointPlace exact_place(const ClosedMesh *mesh, const int32_t point[3]);
