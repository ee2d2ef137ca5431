// SPDX-License-Identifier: MIT
// Builds a Bvh from triangles: a binary tree of boxes with triangles in its leaves (Rubin and
// Whitted, "A 3-dimensional representation for fast rendering of complex scenes", 1980). The number
// of threads does not affect the tree.
#pragma once

#include "accel/triangles.h"

typedef enum { BVH_SAH, BVH_MIDPOINT } BvhBuilder;

// The unit in which the surface area heuristic counts the intersection tests of a leaf.
typedef enum {
    LEAVES_SINGLE, // one triangle per test
    LEAVES_BLOCKS  // a block of up to WIDE triangles per test
} BvhLeaves;

typedef struct {
    BvhBuilder builder;
    BvhLeaves leaves;
} BvhSettings;

typedef struct {
    float low[3], high[3];
} Box;

// If count is not zero, the node is a leaf with the triangles at [first, first + count) of
// Bvh::order. Otherwise its children are the nodes `first` and `first + 1`.
typedef struct {
    Box box; // tight bounds of the triangles below
    uint32_t first, count;
    uint32_t leaf_count; // leaves of the subtree; 1 for a leaf
} BvhNode;

typedef struct {
    BvhNode *nodes;                       // the first is the root; some entries are unused
    uint32_t *order;                      // triangle indices, leaf by leaf
    uint32_t node_count, leaf_count;      // nodes in use; leaves among them
    uint32_t largest_leaf, depth;         // in triangles; in levels, at most BVH_MAX_DEPTH
    uint32_t inner_counts[BVH_MAX_DEPTH]; // inner nodes per level, from the root down
} Bvh;

// Builds the tree. It has no nodes if there are no triangles.
bool bvh_build(Bvh *bvh, const Triangles *triangles, const BvhSettings *settings, ThreadPool *pool,
               Error *error);
void bvh_free(Bvh *bvh);
