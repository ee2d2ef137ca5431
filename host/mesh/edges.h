// SPDX-License-Identifier: MIT
// Mesh -> its points, its edges with their triangles, and fans of triangles around points.
//
// A file's vertices do not show which triangles are neighbors. STL repeats each vertex for each
// triangle, and other files repeat vertices along texture seams. Vertices at equal positions are
// therefore merged into one point. An edge is a pair of points, and may have any number of
// triangles. A fan is a set of triangle corners at one point, joined across edges. "Lower" and
// "higher" compare indices.
//
// Invariant: the order of points, edges and fans follows from the mesh alone, not from hashing or
// sorting.
#pragma once

#include "base/error.h"
#include "mesh/mesh.h"

// The value in Weld::points for a vertex that no triangle uses.
#define WELD_UNUSED UINT32_MAX

typedef struct {
    uint32_t *points;      // by vertex: the lowest used vertex at its position, or WELD_UNUSED
    size_t unused_count;   // vertices that no triangle uses
    size_t repeated_count; // used vertices at the position of a lower used vertex
} Weld;

// A triangle at an edge.
typedef struct {
    uint32_t high;     // the edge's higher point
    uint32_t opposite; // the triangle's third point
    uint32_t triangle : 31;
    uint32_t falling : 1; // the triangle's corners go from the higher point to the lower one
} EdgeSide;

// Sides [first[point], first[point + 1]) belong to the edges from `point` to higher points. These
// sides are sorted by higher point, opposite point and triangle, so the sides of one edge are
// consecutive.
typedef struct {
    Weld weld;
    EdgeSide *sides; // three per triangle
    size_t side_count;
    uint32_t *first; // vertex_count + 1 entries
} Edges;

// Fails if the mesh has 2^32 corners or more.
bool edges_make(Edges *edges, const Mesh *mesh, Error *error);
void edges_free(Edges *edges);

typedef struct {
    uint32_t low; // the edge's lower point
    const EdgeSide *sides;
    size_t count;
} Edge;

// Advances *edge to the next edge, or from {0} to the first edge. Returns false after the last
// edge.
bool edges_next(const Edges *edges, Edge *edge);

// Fans of a mesh. The caller joins them across edges. Corner i of a triangle has the number 3 *
// triangle + i, where i is 0, 1 or 2.
typedef struct {
    const Mesh *mesh;
    const Weld *weld;
    uint32_t *parents; // by corner: a lower corner of the same fan, or the corner itself
} Fans;

// Makes one fan for each corner. `edges` must be made from `mesh`, and both must outlive the fans.
// The caller frees fans->parents.
bool fans_make(Fans *fans, const Mesh *mesh, const Edges *edges, Error *error);

// Joins the fans that two triangles have at their common point `point`.
void fans_join(const Fans *fans, uint32_t point, uint32_t triangle, uint32_t other);

// Replaces each parent by the index of the corner's fan. Fans are numbered in the order of their
// lowest corners. Returns the number of fans. Afterwards, fans cannot be joined.
uint32_t fans_number(Fans *fans);
