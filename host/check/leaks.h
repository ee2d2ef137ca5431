// SPDX-License-Identifier: MIT
// A mesh, alone and two-sided in its scene's frame -> the number of rays aimed at its edges and
// points that pass through it.
#pragma once

#include "check/closedness.h"
#include "check/ray_caster.h"

// The largest number of edges and points to aim at per mesh.
#define LEAKS_AIMS 1048576

typedef struct {
    size_t total;    // edges, points and places beyond open edges
    size_t aimed;    // those that got a ray
    size_t rays;     // some aims get two
    size_t hidden;   // aims behind other parts of the mesh
    MeshFault leaks; // rays that continued behind their aim; first is a triangle there
} LeakCount;

typedef struct {
    const Normalization *normalization;
    const Closedness *closedness; // of the mesh
    ThreadPool *pool;
    BvhBuilder builder;
    bool uses_bvh;
} LeakSetting;

bool leaks_count(LeakCount *count, RayCaster *caster, const Mesh *mesh, const LeakSetting *setting,
                 Error *error);
