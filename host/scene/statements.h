// SPDX-License-Identifier: MIT
// The longer statements of scene text. `define` adds a material to the course's four, and
// `material` selects one. `mesh` and `ply_file` add a mesh file, and `mesh` also transforms it.
#pragma once

#include "scene/mesh_load.h"
#include "scene/scene.h"
#include "scene/tokens.h"

// Reads the rest of a define statement and adds the material to scene.
bool materials_define(Scene *scene, Tokens *tokens);

// The value of `material own`. Each object has the material from its mesh file or, if the file
// gives none, the course's material 0.
#define MATERIAL_OWN UINT32_MAX

// Reads the argument of `material`: the number of a course material, a defined name, or own. As in
// the course, numbers outside 0 to 3 select material 0, the silhouette.
bool materials_select(const Scene *scene, Tokens *tokens, uint32_t *material);

// Reads the rest of a mesh or ply_file statement and adds the file's objects. Paths are relative to
// the scene file's folder.
bool mesh_statement_read(Scene *scene, Tokens *tokens, const MeshLoadOptions *options);
