// SPDX-License-Identifier: MIT
// Scene -> counts of its faulty and unused parts, without rendering it.
#pragma once

#include "check/features.h"
#include "library/clrt.h"
#include "mesh/edges.h"

// A mesh is closed if every edge has two consistently oriented triangles, and the triangles around
// each point form one fan.

// The first four kinds are the faults that the file's reader found (Mesh).
typedef enum {
    FAULT_BAD_POSITIONS,
    FAULT_BAD_NORMALS,
    FAULT_LOST_CORNERS,
    FAULT_EQUAL_CORNERS,
    FAULT_FLAT,       // triangles without area
    FAULT_DUPLICATES, // triangles with the corners of an earlier triangle, in any order
    FAULT_LEAKS,      // rays that passed through a closed mesh
    FAULT_OPEN,       // edges of one triangle
    FAULT_CROWDED,    // edges of more than two triangles
    FAULT_TURNED,     // edges that both triangles follow in the same direction
    FAULT_PINCHED,    // points whose triangles form several fans
    FAULT_KINDS
} FaultKind;

// The counts of one mesh. The `first` of a MeshFault is a triangle at the fault, numbered as in the
// file, or a vertex with a bad position or normal.
typedef struct {
    ClrtCheckedMesh facts; // size and path are unset; the counts of rays are 0 before check_trace
    MeshFault faults[FAULT_KINDS];
    MeshFault leaks; // rays that passed, also through a mesh that is not closed
    Features features;
} MeshCensus;

// Finds duplicate triangles and the faults after FAULT_LEAKS, counts the edges, and finds whether
// the mesh is closed and whether it is inside out.
bool mesh_faults_find(MeshCensus *census, const Mesh *mesh, const Edges *edges, Error *error);

typedef struct {
    MeshCensus *meshes; // by object; owned
    size_t mesh_count;
    size_t empty_meshes;      // objects without a triangle
    size_t duplicate_meshes;  // objects with the triangles of an earlier object
    size_t duplicate_spheres; // spheres with the center and radius of an earlier sphere
    size_t duplicate_lights;  // lights at the position, or suns in the direction, of an earlier one
    size_t unused_materials;  // materials that the file defines, but nothing uses
} Census;

// Counts the faulty and unused parts of a scene. `normalization` must be the scene's normalization.
bool census_take(Census *census, const Scene *scene, const Normalization *normalization,
                 Error *error);
void census_free(Census *census);
