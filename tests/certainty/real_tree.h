// SPDX-License-Identifier: MIT
// Triangles as they are stored -> a tree for tests, unlike the tracer's: halves along the longest
// axis, in boxes wide enough that no rounding matters.
#pragma once

#include "accel/flat.h"

typedef struct {
    double low[3], high[3];
    uint32_t first, count; // of places in order; without a count the children are first, first + 1
} RealNode;

typedef struct {
    RealNode *nodes; // the root first; none without triangles
    uint32_t *order; // places of triangles
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

// The next leaf whose box the ray enters before `reach`, NULL behind the last.
const RealNode *real_walk_next(RealWalk *walk, double reach);
