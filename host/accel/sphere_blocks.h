// SPDX-License-Identifier: MIT
// Spheres of a FlatScene -> the wide tree over them, if they are many.
#pragma once

#include "accel/flat_scene.h"
#include "accel/wide_tree.h"

// Makes the tree's nodes, whose indices start at tree->root, and appends its blocks to
// flat->spheres. Sets flat->sphere_root and flat->sphere_entries. Without a tree, sphere_root is
// NOTHING and the tree has no nodes.
bool sphere_blocks_make(FlatScene *flat, const FlatSource *source, WideTree *tree, Error *error);
