// SPDX-License-Identifier: MIT
// Builds a subtree on one thread, from a range of Bvh::order.
#pragma once

#include "accel/split.h"

// A node that is not divided yet.
typedef struct {
    uint32_t node;
    uint32_t first, count; // range of its triangles in Bvh::order
    uint32_t depth;        // 1 for the root of the tree
} BuildTask;

// The contribution of one subtree to the counts of Bvh. node_count excludes the subtree's root.
typedef struct {
    uint32_t node_count, leaf_count, largest_leaf, depth;
} BuildCounts;

typedef struct {
    Bvh *bvh;
    const Triangles *triangles;
    Split (*split)(const BuildRange *range);
    BvhLeaves leaves;
} Build;

// The bounds of a set of items, and the bounds of their doubled centers (bounds.h).
typedef struct {
    Bounds box, centers;
} Measure;

Measure build_measure(const BuildItem *items, uint32_t count);

// Copies each item to left or right, in their order.
void build_move(const BuildItem *items, uint32_t count, const Split *split, BuildItem *left,
                BuildItem *right);

// Makes task's node an inner node whose children are the nodes `child` and `child + 1`. The first
// gets `left` triangles. Stores the tasks of both in children.
void build_inner(const Build *build, const BuildTask *task, uint32_t left, uint32_t child,
                 BuildTask children[2]);

// Sets an inner node's leaf_count to the sum of its children's. Does not change a leaf.
void build_count_leaves(Bvh *bvh, uint32_t number);

// Builds the subtree below root and adds to counts. items is a buffer for twice root's triangles.
// Nodes below root use indices from 2 * first + 1 to 2 * (first + count) - 2, with first and count
// of root. No other subtree uses these indices.
void build_subtree(const Build *build, const BuildTask *root, BuildItem *items,
                   BuildCounts *counts);
