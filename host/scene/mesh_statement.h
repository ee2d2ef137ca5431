// SPDX-License-Identifier: MIT
// The statements `mesh` and `ply_file`: a mesh file, moved as its statement says, into the scene.
#pragma once

#include "scene/mesh_order.h"
#include "scene/tokens.h"

// Reads the rest of the statement and adds the objects of its file; paths are relative to the scene
// file's folder.
bool mesh_statement_read(Scene *scene, Tokens *tokens, const MeshOrder *order);
