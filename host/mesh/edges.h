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
    uint32_t falling : 1; // the triangle runs from the higher point to the lower one
} EdgeSide;

// Sides [first[point], first[point + 1]) belong to edges from `point` to higher points. They are
// sorted by higher point, opposite point and triangle, so the sides of one edge are consecutive.
typedef struct {
    EdgeSide *sides; // three per triangle
    uint32_t *first; // vertex_count + 1 entries
} Edges;

// Fails if the mesh has more than 2^32 corners.
bool edges_make(Edges *edges, const Mesh *mesh, const Weld *weld, Error *error);
void edges_free(Edges *edges);

// Returns one past the last side of the edge whose first side is sides[place].
static inline size_t edges_end(const Edges *edges, uint32_t point, size_t place)
{
    size_t end = place + 1;
    while (end < edges->first[point + 1] && edges->sides[end].high == edges->sides[place].high)
        end++;
    return end;
}
