// SPDX-License-Identifier: MIT
// Spheres of a FlatScene -> the wide tree over them, if they are many.
#pragma once

#include "accel/flat_scene.h"
#include "accel/wide_tree.h"

// Makes the tree's nodes, whose indices start at tree->root, and appends its blocks to
// flat->spheres. Sets flat->sphere_root and flat->sphere_entries. If there are few spheres
// (flat_has_sphere_tree), there is no tree: *flat stays unchanged, and *tree has no nodes.
bool sphere_blocks_make(FlatScene *flat, const FlatSource *source, WideTree *tree, Error *error);
