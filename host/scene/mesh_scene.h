// SPDX-License-Identifier: MIT
// A mesh that replaces a scene: framed by cameras of its own, lit and two-sided.
#pragma once

#include "base/file.h"
#include "mesh/ply.h"
#include "scene/scene.h"

// Returns whether a file's bytes are a mesh and not scene text.
bool mesh_scene_is_mesh(const char *bytes, size_t size);

// Fills scene from a PLY file called name, read by parse. Viewpoints: three-quarter, front, right,
// back, left and top, with z up.
bool mesh_scene_parse(Scene *scene, const File *file, const char *name, PlyParse *parse,
                      Error *error);

// Fills scene from a file at path in another format, with the file's own materials.
bool mesh_scene_read_foreign(Scene *scene, const char *path, PlyParse *parse, Error *error);
