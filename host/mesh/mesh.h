// SPDX-License-Identifier: MIT
// A triangle mesh as its file describes it: indexed, in fp64, in the file's own coordinates.
#pragma once

#include "base/vec.h"

#include <stddef.h>
#include <stdint.h>

// Faults of one kind.
typedef struct {
    size_t count;
    size_t first; // the lowest index of one, counted from 0
} MeshFault;

static inline void mesh_fault_add(MeshFault *fault, size_t place)
{
    if (fault->count++ == 0 || place < fault->first)
        fault->first = place;
}

typedef struct {
    double (*positions)[3]; // vertex_count finite points, each |component| < 1e30
    float (*normals)[3];    // vertex_count finite vectors of any length, zero for
                            // vertices without one; NULL if the file has no normals
    uint32_t (
        *triangles)[3]; // triangle_count triples below vertex_count, counter-clockwise in front
    size_t vertex_count, triangle_count;
    size_t dropped_count;    // triangles dropped for one of two faults:
    MeshFault equal_corners; // two of its corners are one point
    MeshFault lost_corners;  // a corner's position is unusable; only in tolerant readers
    // Vertices set to zero; only in tolerant readers.
    MeshFault bad_positions, bad_normals;
} Mesh;

// Extends low and high to contain all vertices that triangles use. Unused vertices do not count.
void mesh_add_bounds(const Mesh *mesh, Vec3 *low, Vec3 *high);

// Drops and counts the triangles with equal corners, and those with a lost position, which NaN
// marks. Then clears the lost vertices.
void mesh_drop_triangles(Mesh *mesh);

// Frees the mesh's memory and leaves a valid empty mesh.
void mesh_free(Mesh *mesh);
