// SPDX-License-Identifier: MIT
// Triangles -> Bvh: a binary tree of boxes with triangles in its leaves (Rubin and Whitted,
// "A 3-dimensional representation for fast rendering of complex scenes", 1980).
// The same triangles give the same tree, always.
#pragma once

#include "accel/triangles.h"

typedef enum { BVH_SAH, BVH_MIDPOINT } BvhBuilder;

typedef struct {
    float low[3], high[3];
} Box;

// With a count, a leaf: places [first, first + count) of the order; without, the children are the
// nodes first and first + 1.
typedef struct {
    Box box; // exactly around the triangles below
    uint32_t first, count;
    uint32_t inner; // number among the inner nodes, in the order they were divided; the root's is 0
} BvhNode;

typedef struct {
    BvhNode *nodes;  // node_count of them, the root first, children behind their parents
    uint32_t *order; // the triangles' numbers, leaf after leaf
    uint32_t node_count, leaf_count;
    uint32_t largest_leaf, depth; // levels; at most BVH_MAX_DEPTH
} Bvh;

// Builds the tree; without triangles it has no nodes.
bool bvh_build(Bvh *bvh, const Triangles *triangles, BvhBuilder builder, Error *error);
void bvh_free(Bvh *bvh);
