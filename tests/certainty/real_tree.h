// SPDX-License-Identifier: MIT
// Builds a tree of stored triangles for tests. Unlike clrt's trees, this tree halves the list of
// stored triangles. Triangles that are close in this list are also close in the scene. Boxes are so
// wide that rounding cannot matter.
#pragma once

#include "accel/flat.h"

typedef struct {
    double low[3], high[3];
    uint32_t first, count; // the range in the flat scene's triangles
    uint32_t children;     // the first of two successive nodes; 0 for a leaf
} RealNode;

typedef struct {
    RealNode *nodes; // the root first; empty without triangles
    uint32_t node_count;
} RealTree;

bool real_tree_make(RealTree *tree, const FlatScene *flat, Error *error);
void real_tree_free(RealTree *tree);

// A ray through the tree, in fp64.
typedef struct {
    const RealTree *tree;
    double origin[3], inverse[3];
    uint32_t waiting[64];
    uint32_t count;
} RealWalk;

void real_walk_begin(RealWalk *walk, const RealTree *tree, const double origin[3],
                     const double direction[3]);

// Returns the next leaf whose box the ray enters before `reach`, or NULL after the last.
const RealNode *real_walk_next(RealWalk *walk, double reach);
