// SPDX-License-Identifier: MIT
// A mesh file in another format than PLY -> objects of a scene.
#pragma once

#include "scene/mesh_order.h"

// Adds an object for each part of the file at path, its materials where they are wanted, and all
// files that it was read from.  False with a sentence that names the file.
bool foreign_mesh_add(Scene *scene, const char *path, const MeshOrder *order, Error *error);
