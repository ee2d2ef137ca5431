// SPDX-License-Identifier: MIT
// Rejects models whose polygons have so many corners that Assimp would read them for minutes.
#pragma once

#include "base/file.h"

#include <assimp/scene.h>

// Returns false if the scene's polygons take too long to triangulate.
bool polygons_check_scene(const struct aiScene *scene, Error *error);

// The same for the text of an OBJ file, before Assimp reads it: Assimp 5.4 takes n * n steps or
// more to read a face of n corners.
bool polygons_check_obj(const File *file, Error *error);
