// SPDX-License-Identifier: MIT
// The longer statements of scene text. `define` adds a material, and `material` selects one. `mesh`
// and `ply_file` add a mesh file, and `mesh` also transforms it.
#pragma once

#include "scene/mesh_load.h"
#include "scene/scene.h"
#include "scene/tokens.h"

// Reads the rest of a `define` statement and adds the material to the scene.
bool define_statement_read(Scene *scene, Tokens *tokens);

typedef struct {
    uint32_t plain;   // the material of spheres, and of meshes that get no other material
    uint32_t colored; // if `is_own`: the material of meshes whose files define colors only
    bool is_own;      // meshes have the materials and the colors of their files
} MaterialChoice;

// The choice of `material own`, which is also the choice before the first `material` statement.
extern const MaterialChoice material_own;

// Reads the arguments of `material`: the number of a predefined material, a defined name, or the
// word `own`. After `own`, a material may follow for spheres, and for meshes whose files define no
// material. Numbers outside 0 to 3 select material 0, the silhouette.
bool material_statement_read(const Scene *scene, Tokens *tokens, MaterialChoice *choice);

// Reads the rest of a `mesh` or `ply_file` statement and adds the file's objects. Paths are
// relative to the scene file's folder.
bool mesh_statement_read(Scene *scene, Tokens *tokens, const MeshLoadOptions *options);
