// SPDX-License-Identifier: MIT
// A closed surface of quads with shared vertices.
#pragma once

#include "grid.h"

#include <stdint.h>

typedef struct {
    Vec3 *positions;
    Vec3 *normals;        // of length 1, outward; zero after surface_extract
    uint32_t (*quads)[4]; // counter-clockwise from outside; drawn as triangles 0 1 2 and 0 2 3
    size_t vertex_count, quad_count;
} Surface;

// Polygonizes the grid's surface. Returns false only if memory runs out.
bool surface_extract(Surface *surface, const Grid *grid, Error *error);

void surface_free(Surface *surface);
