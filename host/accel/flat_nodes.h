// SPDX-License-Identifier: MIT
// The tree and the triangles of a flattened scene, in either layout.
#pragma once

#include "accel/flat_scene.h"

// Fills the pair layout: a BvhPair for every inner node or for a root that is a leaf, and the
// triangles in leaf order. The looks move into the triangles.
bool flat_pair_make(FlatScene *flat, const FlatSource *source, Error *error);

// Fills the wide layout: nodes of up to eight children, and blocks of triangles. The triangles'
// flags move from the looks to the blocks. Without a tree, both layouts keep the file's order.
bool flat_wide_make(FlatScene *flat, const FlatSource *source, Error *error);
