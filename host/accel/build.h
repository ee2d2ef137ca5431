// SPDX-License-Identifier: MIT
// Builds one subtree on one thread, from a range of triangles in the tree's order.
#pragma once

#include "accel/split.h"

// A node that is still to be divided.
typedef struct {
    uint32_t node;
    uint32_t first, count; // positions of its triangles
    uint32_t depth;        // the root's is 1
} BuildTask;

// A builder's contributions to the tree's counts.
typedef struct {
    uint32_t node_count, leaf_count, largest_leaf, depth;
} BuildCounts;

typedef struct {
    Bvh *bvh;
    const Triangles *triangles;
    Split (*split)(const BuildRange *range);
    BvhLeaves leaves;
} Build;

// The bounds of a node, and of its items' doubled centers.
typedef struct {
    Bounds box, centers;
} Measure;

Measure build_measure(const BuildItem *items, uint32_t count);

// Appends each item to left or right and keeps their order.
void build_move(const BuildItem *items, uint32_t count, const Split *split, BuildItem *left,
                BuildItem *right);

// Makes the node an inner one. Its children are the nodes from child on, which are to be divided.
void build_inner(const Build *build, const BuildTask *task, uint32_t left, uint32_t child,
                 BuildTask children[2]);

// Sums the leaf counts of an inner node's children.
void build_count_leaves(Bvh *bvh, uint32_t number);

// Builds the subtree of the root. items must have room for twice its triangles. The nodes below
// the root use some of the indices [2 * first + 1, 2 * (first + count) - 1), which no other
// subtree uses.
void build_subtree(const Build *build, const BuildTask *root, BuildItem *items,
                   BuildCounts *counts);
