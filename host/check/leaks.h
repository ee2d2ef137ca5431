// SPDX-License-Identifier: MIT
// A mesh, alone and two-sided in its scene's frame -> how many rays aimed at its edges and points
// pass through it.
#pragma once

#include "check/closedness.h"
#include "check/ray_caster.h"

// Of each mesh, so many edges and points at most are aimed at.
#define LEAKS_AIMS 1048576

typedef struct {
    size_t total;    // edges and points, and places beyond open edges
    size_t aimed;    // of these, as many as have had a ray
    size_t rays;     // some were aimed at twice
    size_t hidden;   // of those aimed at: behind other parts of the mesh
    MeshFault leaks; // rays that went on behind the aim; the first's triangle
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
