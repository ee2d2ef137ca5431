// SPDX-License-Identifier: MIT
// Computes the normals that a mesh lacks, and chooses crease angles.
#pragma once

#include "mesh/mesh.h"

// Stands for the crease angle that suits the mesh's shape.
#define CREASE_BY_SHAPE (-1)

// The crease angle for `normals smooth` without an angle, and for most mesh files without a scene.
#define CREASE_DEGREES 33

// Returns whether every corner of every triangle has a normal.
bool mesh_has_all_normals(const Mesh *mesh);

// Computes a normal of length 1 for each used vertex without a normal. The result is the mean of
// the normals of the triangles around the vertex, weighted by the triangles' angles at the vertex.
// Vertices at equal positions count as one vertex.
//
// Edges stay sharp if the normals of their triangles differ by more than `crease_degrees`, which is
// in [0, 180] or CREASE_BY_SHAPE. No computed normal differs by more than this angle from the
// normal of its triangle. Corners of triangles that are nearly lines get no computed normal.
//
// If a normal is missing, the function replaces all vertices by new vertices. The triangles keep
// their order. Equal arguments give equal bits. On failure, the mesh is unchanged.
bool mesh_compute_normals(Mesh *mesh, double crease_degrees, Error *error);

// The following declarations choose a crease angle by a mesh's shape.

#define ANGLE_WINDOW_DEGREES 5
#define ANGLE_WINDOWS        15

// Counts of edges by the angle between the normals of their two triangles. Window i counts angles
// from 5 * i up to 5 * i + 5 degrees.
typedef struct {
    size_t edges; // all edges of two triangles
    size_t windows[ANGLE_WINDOWS];
} EdgeAngles;

// Adds all edges of the mesh that have two triangles.
bool normals_add_angles(EdgeAngles *angles, const Mesh *mesh, Error *error);

// Returns 70 degrees if the angles indicate a smooth shape, such as a scan. In coarse parts of such
// shapes, angles exceed CREASE_DEGREES. Returns CREASE_DEGREES for other shapes, whose edges may be
// meant to be sharp.
double normals_crease(const EdgeAngles *angles);
