// SPDX-License-Identifier: MIT
// Computes the normals that a mesh lacks.
#pragma once

#include "base/error.h"
#include "mesh/mesh.h"

// The crease angle of lone meshes and of scenes that name none.
#define CREASE_DEGREES 33

// Gives each used vertex without a normal one of length 1: the mean of the faces around it,
// weighted by their angles. Vertices at one position count as one. Edges with an angle of more than
// crease_degrees, from 0 to 180, between the normals of their faces stay sharp. The mesh gets new
// vertices, one for each normal at a position; the triangles keep their order. No computed normal
// is further than crease_degrees from the normal of its triangle. Corners of triangles without area
// may stay without a normal. The result depends on the mesh only, bit for bit. On failure, the mesh
// is unchanged.
bool mesh_compute_normals(Mesh *mesh, double crease_degrees, Error *error);
