// SPDX-License-Identifier: MIT
// Parses scene text into a Scene. The table in scn.c defines the grammar.
#pragma once

#include "scene/mesh_scene.h"

// Parses the `size` bytes of a scene file. Mesh paths are relative to the folder of the file
// `name`. Returns false at the first error. Messages about the text begin with name:line:column.
bool scn_parse(Scene *scene, const char *text, size_t size, const char *name, Error *error);

// Loads a scene file or a lone mesh file (mesh_scene.h).
bool scn_load(Scene *scene, const char *path, const SceneLoadOptions *options, Error *error);

// Loads a scene file or a PLY file with the contents `file`. Mesh paths are relative to the folder
// of the file `name`.
bool scn_take(Scene *scene, const File *file, const char *name, const SceneLoadOptions *options,
              Error *error);
