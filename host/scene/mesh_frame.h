// SPDX-License-Identifier: MIT
// Cameras for a mesh without a scene.
#pragma once

#include "scene/triangle_runs.h"

// The place of a scene's meshes.
typedef struct {
    TriangleRuns runs;
    Vec3 center;   // of the bounding box
    double radius; // half its diagonal, or 1 if that is zero
} MeshPlace;

// Adds six viewpoints: three-quarter, front, right, back, left and top. From each, the meshes fill
// 80 % of the picture's width or height, whichever is less.
bool mesh_frame_add_views(Scene *scene, const MeshPlace *place, Error *error);
