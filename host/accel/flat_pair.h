// SPDX-License-Identifier: MIT
// Bvh and triangles -> the layout of pairs: a node for every inner node of the tree, with both
// children's boxes, and the triangles in the order of the leaves.
#pragma once

#include "accel/flat.h"

// Fills flat's pairs and triangles; the looks move into the triangles.
bool flat_pair_make(FlatScene *flat, const FlatSource *source, Error *error);

// How many pairs the tree takes: its inner nodes, and one where the root is a leaf.
uint32_t flat_pair_count(const Bvh *bvh);

// Fills flat_pair_count(bvh) pairs, the root first.
void flat_pair_write(BvhPair *pairs, const Bvh *bvh);
