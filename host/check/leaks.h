// SPDX-License-Identifier: MIT
// Mesh -> the number of rays toward its edges and points that pass through it. The mesh is traced
// alone and two-sided, in its scene's frame.
#pragma once

#include "check/closedness.h"
#include "check/ray_caster.h"

// The most aims of a mesh that get rays.
#define LEAKS_AIMS 1048576

typedef struct {
    size_t total;    // aims of the mesh (aims.h): edges, points and positions beyond open edges
    size_t aimed;    // aims that got a ray
    size_t rays;     // rays cast; some aims got two
    size_t hidden;   // aims behind other parts of the mesh
    MeshFault leaks; // rays that passed through; first is a triangle at one of them
} LeakCount;

typedef struct {
    const Normalization *normalization;
    const Closedness *closedness; // of the mesh
    Crew *crew;
    BvhBuilder builder;
    bool uses_bvh;
} LeakSetting;

bool leaks_count(LeakCount *count, RayCaster *caster, const Mesh *mesh, const LeakSetting *setting,
                 Error *error);
