// SPDX-License-Identifier: MIT
// Scene -> counts of its faulty and unused parts, without rendering it.
#pragma once

#include "check/features.h"
#include "library/clrt.h"
#include "mesh/edges.h"

// A mesh is closed if every edge has two consistently oriented triangles, and the triangles around
// each point form one fan.

// The counts of one mesh. Triangles are numbered as in the file. The faults that the file's reader
// found are in the Mesh.
typedef struct {
    ClrtCheckedMesh facts; // size and path are unset; the counts of rays are 0 before check_trace
    // Each MeshFault counts edges, points, triangles or rays. Its `first` is a triangle at a fault.
    MeshFault open;       // edges of one triangle
    MeshFault crowded;    // edges of more than two triangles
    MeshFault turned;     // edges that both triangles follow in the same direction
    MeshFault pinched;    // points whose triangles form several fans
    MeshFault duplicates; // triangles with the corners of an earlier triangle, in any order
    MeshFault leaks;      // rays that passed
    Features features;
} MeshCensus;

// Finds the first five faults, counts the edges, and finds whether the mesh is closed.
bool mesh_faults_find(MeshCensus *census, const Mesh *mesh, const Weld *weld, const Edges *edges,
                      Error *error);

typedef struct {
    MeshCensus *meshes; // by object; owned
    size_t mesh_count;
    size_t empty_meshes;      // objects without a triangle
    size_t duplicate_meshes;  // objects with the triangles of an earlier object
    size_t duplicate_spheres; // spheres with the center and radius of an earlier sphere
    size_t duplicate_lights;  // lights at the position, or suns in the direction, of an earlier one
    size_t unused_materials;  // materials that the file defines, but nothing uses
} Census;

// Counts the faulty and unused parts of a scene. `normalization` must be the scene's.
bool census_take(Census *census, const Scene *scene, const Normalization *normalization,
                 Error *error);
void census_free(Census *census);
