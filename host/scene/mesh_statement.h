// SPDX-License-Identifier: MIT
// The statements `mesh` and `ply_file`: a mesh file, moved as its statement says, into the scene.
#pragma once

#include "scene/ply.h"
#include "scene/scene.h"
#include "scene/tokens.h"

// Reads the rest of the statement and adds object with its mesh, as parse reads it; paths are
// relative to the scene file's folder.
bool mesh_statement_read(Scene *scene, Tokens *tokens, MeshObject object, PlyParse *parse);
