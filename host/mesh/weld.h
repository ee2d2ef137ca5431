// SPDX-License-Identifier: MIT
// Merges a mesh's vertices into points: vertices at the same position are one point to a ray.
#pragma once

#include "base/error.h"
#include "mesh/mesh.h"

// The point of a vertex that no triangle uses.
#define WELD_UNUSED UINT32_MAX

typedef struct {
    uint32_t *points;                    // by vertex: the lowest used vertex at its position
    size_t unused_count, repeated_count; // vertices without a point, and vertices with another's
} Weld;

bool weld_make(Weld *weld, const Mesh *mesh, Error *error);
void weld_free(Weld *weld);
