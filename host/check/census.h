// SPDX-License-Identifier: MIT
// Scene -> counts of what is wrong or idle in it, without drawing it.
#pragma once

#include "check/closedness.h"
#include "check/features.h"
#include "scene/scene.h"

// Of one object.  What the mesh's reader found is in the mesh.
typedef struct {
    Closedness closedness;
    Features features;
    size_t unused_vertices;   // that no triangle uses
    size_t repeated_vertices; // at the position of another in use
} MeshCensus;

typedef struct {
    MeshCensus *meshes; // by object; owned
    size_t mesh_count;
    size_t empty_meshes;      // objects without a triangle
    size_t duplicate_meshes;  // objects whose triangles are those of one before
    size_t duplicate_spheres; // with center and radius of one before
    size_t duplicate_lights;  // at the position of one before
    size_t unused_materials;  // defined, and no object's or sphere's
} Census;

// The scene's frame is normalization_of it.
bool census_take(Census *census, const Scene *scene, const Normalization *normalization,
                 Error *error);
void census_free(Census *census);
