// SPDX-License-Identifier: MIT
// Builds one subtree, from the triangles at a range of places of the order, by one thread.
#pragma once

#include "accel/split.h"

// A node that is still to be divided.
typedef struct {
    uint32_t node;
    uint32_t first, count; // places of its triangles
    uint32_t depth;        // the root's is 1
} BuildTask;

// What building adds to a tree.
typedef struct {
    uint32_t node_count, leaf_count, largest_leaf, depth;
} BuildCounts;

typedef struct {
    Bvh *bvh;
    const Triangles *triangles;
    Split (*split)(const BuildRange *range);
    BvhLeaves leaves;
} Build;

// A node's bounds, and those of its items' doubled centers.
typedef struct {
    Bounds box, centers;
} Measure;

Measure build_measure(const BuildItem *items, uint32_t count);

// Appends the items to left or to right, in their order.
void build_move(const BuildItem *items, uint32_t count, const Split *split, BuildItem *left,
                BuildItem *right);

// Makes the node an inner one, whose children are the nodes from child on and are to be divided.
void build_inner(const Build *build, const BuildTask *task, uint32_t left, uint32_t child,
                 BuildTask children[2]);

// Adds up the leaves below a node's children, where it has any.
void build_count_leaves(Bvh *bvh, uint32_t number);

// Divides the root and all below it; items has room for the double of its triangles.  The nodes
// below the root take some of the places [2 * first + 1, 2 * (first + count) - 1), which no other
// subtree does.
void build_subtree(const Build *build, const BuildTask *root, BuildItem *items,
                   BuildCounts *counts);
