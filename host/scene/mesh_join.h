// SPDX-License-Identifier: MIT
// The meshes of a scene, one behind the other, as one.
#pragma once

#include "scene/scene.h"

// Fills mesh with all triangles in the scene's order.  Normals that an object does without are
// zero.
bool mesh_join(Mesh *mesh, const Scene *scene, Error *error);
