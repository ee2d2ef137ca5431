// SPDX-License-Identifier: MIT
// Scene -> counts of its faulty and unused parts, without rendering it.
#pragma once

#include "check/closedness.h"
#include "check/features.h"

// The counts of one mesh. The Mesh itself holds the faults that its file reader found.
typedef struct {
    Closedness closedness;
    Features features;
    size_t unused_vertices;   // vertices that no triangle uses
    size_t repeated_vertices; // used vertices at the position of another used vertex
} MeshCensus;

typedef struct {
    MeshCensus *meshes; // by object; owned
    size_t mesh_count;
    size_t empty_meshes;      // objects without a triangle
    size_t duplicate_meshes;  // objects with the triangles of an earlier one
    size_t duplicate_spheres; // spheres with center and radius of an earlier one
    size_t duplicate_lights;  // lights at the position of an earlier one
    size_t unused_materials;  // defined in the file, but not used
} Census;

// Counts the parts of a scene. `normalization` must be normalization_of the scene.
bool census_take(Census *census, const Scene *scene, const Normalization *normalization,
                 Error *error);
void census_free(Census *census);
