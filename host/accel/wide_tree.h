// SPDX-License-Identifier: MIT
// A Bvh -> wide nodes and the ranges of their blocks. The items are triangles or spheres.
#pragma once

#include "accel/bvh_tree.h"

// The items [first, first + count) of Bvh::order or, without a tree, of the scene.
typedef struct {
    uint32_t first, count;
} ItemRange;

// The caller sets the first three members.
typedef struct {
    const Bvh *bvh;
    uint32_t root;      // index of the first node, in the array for which the nodes are made
    uint32_t leaf_bits; // of children that are blocks
    BvhWide *nodes;     // node_count nodes; owned
    ItemRange *blocks;  // block_count ranges of at most WIDE items; owned
    uint32_t node_count, block_count;
} WideTree;

// If the Bvh has no nodes, lists blocks of item_count items without nodes. Call wide_tree_free
// after success and after failure.
bool wide_tree_make(WideTree *tree, uint32_t item_count, Error *error);
void wide_tree_free(WideTree *tree);

// Moves each plane of a box outward by `share` times the box's largest coordinate.
Box box_grow(const Box *box, float share);

// Stores a child's box, grown by BVH_SLACK, in the planes of a node with room for `children`
// children. If box is NULL, no ray enters the stored box. On each axis, the low planes of all
// children precede the high planes.
void box_store(float *planes, uint32_t children, uint32_t child, const Box *box);
