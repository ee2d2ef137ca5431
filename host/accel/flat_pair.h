// SPDX-License-Identifier: MIT
// Converts a Bvh and its triangles to the layout of pairs: a node with both children's boxes for
// every inner node, and the triangles in leaf order.
#pragma once

#include "accel/flat.h"

// Fills flat's pairs and triangles. The looks move into the triangles.
bool flat_pair_make(FlatScene *flat, const FlatSource *source, Error *error);

// Returns the number of pairs: one per inner node, and one if the root is a leaf.
uint32_t flat_pair_count(const Bvh *bvh);

// Fills flat_pair_count(bvh) pairs, the root first.
void flat_pair_write(BvhPair *pairs, const Bvh *bvh);
