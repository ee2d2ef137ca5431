// SPDX-License-Identifier: MIT
// The statements `mesh` and `ply_file` add a transformed mesh file to the scene.
#pragma once

#include "scene/mesh_order.h"
#include "scene/tokens.h"

// Reads the rest of the statement and adds the file's objects. Paths are relative to the scene
// file's folder.
bool mesh_statement_read(Scene *scene, Tokens *tokens, const MeshOrder *order);
