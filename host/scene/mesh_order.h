// SPDX-License-Identifier: MIT
// How a mesh file is to be taken into a scene.
#pragma once

#include "mesh/ply.h"
#include "scene/scene.h"

typedef struct {
    MeshObject object;        // what its objects are beside their meshes
    bool takes_own_materials; // in place of the object's, where the file has any
    bool is_plain_ply;        // PLY alone, without transforms
    PlyParse *parse;          // how meshes are read
} MeshOrder;
