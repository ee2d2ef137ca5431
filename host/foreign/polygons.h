// SPDX-License-Identifier: MIT
// Rejects models whose polygons have so many corners that Assimp would take too long.
#pragma once

#include "base/file.h"

#include <assimp/scene.h>

// Returns false if the scene's polygons take too long to triangulate.
bool polygons_check_scene(const struct aiScene *scene, Error *error);

// Returns false if the polygons of an OBJ file take too long. This check reads the file's text
// before Assimp does, because Assimp 5.4 takes at least n * n steps to read a face of n corners.
bool polygons_check_obj(const File *file, Error *error);
