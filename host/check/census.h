// SPDX-License-Identifier: MIT
// Scene -> counts of its faulty and unused parts, without rendering it.
#pragma once

#include "check/closedness.h"
#include "check/features.h"
#include "scene/scene.h"

// The counts of one object.  The mesh itself holds the faults that its reader found.
typedef struct {
    Closedness closedness;
    Features features;
    size_t unused_vertices;   // no triangle uses them
    size_t repeated_vertices; // at the position of another used vertex
} MeshCensus;

typedef struct {
    MeshCensus *meshes; // by object; owned
    size_t mesh_count;
    size_t empty_meshes;      // objects without a triangle
    size_t duplicate_meshes;  // objects with the triangles of an earlier one
    size_t duplicate_spheres; // with center and radius of an earlier one
    size_t duplicate_lights;  // at the position of an earlier one
    size_t unused_materials;  // defined, but of no object or sphere
} Census;

// Requires normalization_of the scene.
bool census_take(Census *census, const Scene *scene, const Normalization *normalization,
                 Error *error);
void census_free(Census *census);
