// SPDX-License-Identifier: MIT
// How to load a mesh file into a scene.
#pragma once

#include "mesh/ply.h"
#include "scene/scene.h"

typedef struct {
    MeshObject object;        // properties of its objects beside their meshes
    bool takes_own_materials; // instead of the object's, if the file has any
    bool is_plain_ply;        // PLY only, without transforms
    PlyParse *parse;          // the mesh reader
} MeshOrder;
