// SPDX-License-Identifier: MIT
// Scene -> the views whose eye is inside an object, and the meshes that no view shows.
#pragma once

#include "check/census.h"

typedef struct {
    size_t count;  // views whose eye is inside a sphere or a closed mesh
    size_t view;   // the first one, from 1
    size_t sphere; // that contains its eye, from 1; 0 if it is in a mesh
    size_t object; // the mesh, if sphere is 0
} EnclosedEyes;

// clrt draws only the first of the course's six views unless asked, so the others do not count.
EnclosedEyes enclosed_eyes_find(const Scene *scene, const Census *census);

// Returns whether the bounding box of an object with triangles is outside every view.
bool is_out_of_view(const Scene *scene, const Normalization *normalization, size_t object);
