// SPDX-License-Identifier: MIT
// A Bvh over items (triangles or spheres) -> wide nodes, and the items of each block.
#pragma once

#include "accel/bvh_tree.h"

// The items [first, first + count) of Bvh::order or, without a tree, of the scene.
typedef struct {
    uint32_t first, count;
} ItemRange;

// The caller sets the first three members.
typedef struct {
    const Bvh *bvh;
    uint32_t root;      // index of nodes[0] in FlatScene::wides
    uint32_t leaf_bits; // set in the index of a child that is a block: WIDE_LEAF or WIDE_SPHERES
    BvhWide *nodes;     // node_count nodes; owned
    ItemRange *blocks;  // block_count ranges of at most WIDE items; owned
    uint32_t node_count, block_count;
    uint32_t *left_slots; // for each node of bvh: 4 bits for each number of slots; owned
} WideTree;

// Makes the nodes and blocks of tree->bvh. If this Bvh has no nodes, makes only blocks, of items 0
// to item_count - 1. Call wide_tree_free after success and after failure.
bool wide_tree_make(WideTree *tree, uint32_t item_count, Error *error);
void wide_tree_free(WideTree *tree);

// Returns the box with each plane moved outward by `share` times the box's largest coordinate.
Box box_grow(const Box *box, float share);

// Stores a child's box, grown by BVH_SLACK, in the planes of a node with room for `children`
// children. If `box` is NULL, no ray enters the stored box. On each axis, the low planes of all
// children precede the high planes.
void box_store(float *planes, uint32_t children, uint32_t child, const Box *box);
