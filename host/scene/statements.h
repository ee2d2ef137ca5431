// SPDX-License-Identifier: MIT
// The statements of scene text with files of their own: `define` and `material` name materials
// beside the course's four numbered ones; `mesh` and `ply_file` add a transformed mesh file.
#pragma once

#include "scene/mesh_load.h"
#include "scene/scene.h"
#include "scene/tokens.h"

// Reads the rest of a define statement and adds the material to scene.
bool materials_define(Scene *scene, Tokens *tokens);

// The selection of `material own`: each mesh has the materials of its file. An object without a
// material in a file has the course's material 0.
#define MATERIAL_OWN UINT32_MAX

// Reads the argument of `material`: a number of the course, a defined name, or own. As in the
// course, any number but 0 to 3 selects the silhouette.
bool materials_select(const Scene *scene, Tokens *tokens, uint32_t *material);

// Reads the rest of a mesh or ply_file statement and adds the file's objects. Paths are relative to
// the scene file's folder.
bool mesh_statement_read(Scene *scene, Tokens *tokens, const MeshLoadOptions *options);
