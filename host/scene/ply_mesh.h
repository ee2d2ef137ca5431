// SPDX-License-Identifier: MIT
// A PLY file -> an object of a scene.
#pragma once

#include "base/file.h"
#include "scene/mesh_order.h"

// Adds an object with the mesh of the file that was read from path, and the file to the inputs.
bool ply_mesh_add(Scene *scene, const File *file, const char *path, const MeshOrder *order,
                  Error *error);
