// SPDX-License-Identifier: MIT
// Concatenates the meshes of a scene into one.
#pragma once

#include "scene/scene.h"

// Fills mesh with all triangles in the scene's order. Objects without normals get zero normals.
bool mesh_join(Mesh *mesh, const Scene *scene, Error *error);
