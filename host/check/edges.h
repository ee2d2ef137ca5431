// SPDX-License-Identifier: MIT
// Mesh -> its points, merged vertices, because vertices at the same position are one point to a
// ray. Points -> edges, each with its triangles.
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

// A triangle at an edge.
typedef struct {
    uint32_t high;     // the edge's higher point
    uint32_t opposite; // the triangle's third point
    uint32_t triangle : 31;
    uint32_t falling : 1; // it runs from the edge's higher point to the lower one
} EdgeSide;

// The sides of a point's edges to higher points are [first[point], first[point + 1]).  Sorting by
// higher point, opposite point and triangle makes the sides of an edge consecutive.
typedef struct {
    EdgeSide *sides; // three a triangle
    size_t *first;   // vertex_count + 1
} Edges;

bool edges_make(Edges *edges, const Mesh *mesh, const Weld *weld, Error *error);
void edges_free(Edges *edges);

// Returns one past the last side of the edge that starts at place.
static inline size_t edges_end(const Edges *edges, uint32_t point, size_t place)
{
    size_t end = place + 1;
    while (end < edges->first[point + 1] && edges->sides[end].high == edges->sides[place].high)
        end++;
    return end;
}
