// SPDX-License-Identifier: MIT
// A Bvh and its triangles -> the tree and the triangles of a FlatScene, in either layout.
#pragma once

#include "accel/flat_scene.h"

// Fills the pair layout: a BvhPair for every inner node, and the triangles in leaf order. If the
// root is a leaf, it gets a BvhPair too. Moves flat->looks into the triangles.
bool flat_nodes_make_pairs(FlatScene *flat, const FlatSource *source, Error *error);

// Fills the wide layout: nodes of up to eight children, and blocks of triangles. If there are many
// spheres (flat_has_sphere_tree), makes a tree over them too. Moves the triangles' flags from
// flat->looks to the blocks. Without a tree, the triangles of both layouts are in file order.
bool flat_nodes_make_wide(FlatScene *flat, const FlatSource *source, Error *error);

// Returns a box around all primitives, grown by SKY_SLACK. Without primitives, the box is
// unspecified. flat->spheres must hold the scene's spheres.
Box flat_nodes_bounds(const FlatScene *flat, const FlatSource *source);
