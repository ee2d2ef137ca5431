// SPDX-License-Identifier: MIT
// Adds a PLY file to a scene as an object.
#pragma once

#include "base/file.h"
#include "scene/mesh_order.h"

// Adds an object with the mesh of the file read from path, and adds the file to the inputs.
bool ply_mesh_add(Scene *scene, const File *file, const char *path, const MeshOrder *order,
                  Error *error);
