// SPDX-License-Identifier: MIT
// Mesh -> the number of rays that pass through it at its edges and points. The mesh is traced alone
// and two-sided, in its scene's normalized coordinates.
#pragma once

#include "check/aims.h"
#include "check/census.h"
#include "session/ray_caster.h"

// The check casts rays at no more than this number of aims per mesh.
#define LEAKS_AIMS 1048576

typedef struct {
    size_t total;    // aims of the mesh (aims.h): edges, points and positions beyond open edges
    size_t aimed;    // aims that got a ray
    size_t rays;     // rays cast; some aims got two
    size_t hidden;   // aims behind other parts of the mesh
    MeshFault leaks; // rays that passed; `first` is a triangle there, numbered as in the file
} LeakCount;

typedef struct {
    const Session *session;
    const Normalization *normalization; // of the mesh's scene
    const Closedness *closedness;       // of the mesh
} LeakSetting;

bool leaks_count(LeakCount *count, RayCaster *caster, const MeshObject *given,
                 const LeakSetting *setting, Error *error);
