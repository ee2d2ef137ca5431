// SPDX-License-Identifier: MIT
// Scene text -> Scene.  The grammar is the course's four statements and clrt's extension; the
// table in scn.c is its definition.
#pragma once

#include "base/error.h"
#include "base/file.h"
#include "mesh/ply.h"
#include "scene/scene.h"

// Parses the size bytes of a scene file; meshes are read from beside the file called name.
// False with "name:line:column: ..." at the first thing that is not understood.
bool scn_parse(Scene *scene, const char *text, size_t size, const char *name, Error *error);

// The same from the file at path, which may also be a mesh alone (mesh_scene.h).  parse_mesh reads
// PLY meshes: ply_parse or ply_parse_tolerantly.
bool scn_load(Scene *scene, const char *path, PlyParse *parse_mesh, Error *error);

// The same from a file in memory; its meshes are beside a file called name.
bool scn_take(Scene *scene, const File *file, const char *name, PlyParse *parse_mesh, Error *error);
