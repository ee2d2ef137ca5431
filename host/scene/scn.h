// SPDX-License-Identifier: MIT
// Scene text -> Scene.  The grammar is the course's four statements and clrt's extension; the
// table in scn.c is its definition.
#pragma once

#include "base/error.h"
#include "base/file.h"
#include "scene/scene.h"

// Parses the size bytes of a scene file; meshes are read from beside the file called name.
// False with "name:line:column: ..." at the first thing that is not understood.
bool scn_parse(Scene *scene, const char *text, size_t size, const char *name, Error *error);

// The same from a file, which may also be a mesh alone (mesh_scene.h).
bool scn_load(Scene *scene, const char *path, Error *error);

// The same with meshes read by ply_parse_tolerantly.
bool scn_load_tolerantly(Scene *scene, const char *path, Error *error);

// Both of what file holds, wherever it was read from; its meshes are beside a file of that name.
bool scn_take(Scene *scene, const File *file, const char *name, Error *error);
bool scn_take_tolerantly(Scene *scene, const File *file, const char *name, Error *error);
