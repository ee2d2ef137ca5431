// SPDX-License-Identifier: MIT
// A triangle mesh as a file gave it: indexed, in fp64, in the file's own coordinates.
#pragma once

#include "base/vec.h"

#include <stddef.h>
#include <stdint.h>

// Faults of one kind.
typedef struct {
    size_t count;
    size_t first; // the lowest place of one, counted from 0
} MeshFault;

static inline void mesh_fault_add(MeshFault *fault, size_t place)
{
    if (fault->count++ == 0 || place < fault->first)
        fault->first = place;
}

typedef struct {
    double (*positions)[3]; // vertex_count finite points, each component below 1e30 in size
    float (*normals)[3];    // vertex_count finite vectors of any length, zero where the file
                            // gives none for that vertex; NULL when the file has none at all
    uint32_t (
        *triangles)[3]; // triangle_count triples below vertex_count, counter-clockwise in front
    size_t vertex_count, triangle_count;
    size_t dropped_count;    // triangles left out, for either of these faults:
    MeshFault equal_corners; // two of its corners are one point
    MeshFault lost_corners;  // a corner's position was not usable; of tolerant readers alone
    // Vertices, of tolerant readers alone; both become zero.
    MeshFault bad_positions, bad_normals;
} Mesh;

// Widens low and high to hold the vertices that triangles use: a stray one counts for nothing.
void mesh_add_bounds(const Mesh *mesh, Vec3 *low, Vec3 *high);

// Drops the triangles with equal corners and, where some positions are lost, which NaN marks, those
// that use one; counts both, and clears what was lost.
void mesh_drop_triangles(Mesh *mesh);

// Frees what the mesh owns and leaves a valid empty mesh.
void mesh_free(Mesh *mesh);
