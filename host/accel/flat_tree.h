// SPDX-License-Identifier: MIT
// Bvh -> the device's nodes: one for every inner node, with both children's boxes grown by the
// slack that makes culling conservative (kernels/traverse.cl).
#pragma once

#include "accel/bvh.h"

// How many device nodes the tree takes: its inner nodes, and one where the root is a leaf.
uint32_t flat_tree_size(const Bvh *bvh);

// Fills flat_tree_size(bvh) nodes, the root first.
void flat_tree_write(BvhPair *nodes, const Bvh *bvh);
