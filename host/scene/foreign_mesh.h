// SPDX-License-Identifier: MIT
// Adds a mesh file in another format than PLY to a scene as objects.
#pragma once

#include "scene/mesh_order.h"

// Adds an object for each part of the file at path, its materials if requested, and all files that
// it was read from. Returns false with a message that names the file.
bool foreign_mesh_add(Scene *scene, const char *path, const MeshOrder *order, Error *error);
