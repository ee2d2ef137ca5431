// SPDX-License-Identifier: MIT
// Cameras for a mesh without a scene.
#pragma once

#include "scene/scene.h"

// Adds six viewpoints: three-quarter, front, right, back, left and top. From each, the meshes fill
// 80 % of the picture's width or height, whichever is less. All meshes are inside the sphere.
bool mesh_frame_add_views(Scene *scene, Vec3 center, double radius, Error *error);
