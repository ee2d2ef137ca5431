// SPDX-License-Identifier: MIT
// A binary tree of boxes with triangles (or spheres) in its leaves, and the settings of its
// builder.
#pragma once

#include "scene/scene.h"

typedef enum { BVH_SAH, BVH_MIDPOINT } BvhBuilder;

// The triangles that one intersection test covers. The surface area heuristic counts these tests.
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
} BvhNode;

typedef struct {
    BvhNode *nodes;                  // the first is the root; some entries are unused
    uint32_t *order;                 // triangle indices, leaf by leaf
    uint32_t node_count, leaf_count; // nodes in use; leaves among them
    uint32_t largest_leaf, depth;    // triangles of the largest leaf; levels, at most BVH_MAX_DEPTH
    uint32_t inner_counts[BVH_MAX_DEPTH]; // inner nodes per level, from the root down
} Bvh;
