// SPDX-License-Identifier: MIT
// Builds a Bvh from triangles: a binary tree of boxes with triangles in its leaves (Rubin and
// Whitted, "A 3-dimensional representation for fast rendering of complex scenes", 1980). The same
// triangles always give the same tree, regardless of the number of threads.
#pragma once

#include "accel/triangles.h"

typedef enum { BVH_SAH, BVH_MIDPOINT } BvhBuilder;

// The unit of a leaf's test cost, from which the surface area heuristic derives the leaf size.
typedef enum {
    LEAVES_SINGLE, // its triangles one by one
    LEAVES_BLOCKS  // blocks of WIDE triangles, a block at once
} BvhLeaves;

typedef struct {
    BvhBuilder builder;
    BvhLeaves leaves;
} BvhSettings;

typedef struct {
    float low[3], high[3];
} Box;

// A node with a count is a leaf: positions [first, first + count) of the order. Otherwise the
// children are the nodes first and first + 1.
typedef struct {
    Box box; // exactly around the triangles below
    uint32_t first, count;
    uint32_t leaf_count; // leaves below; a leaf counts itself
} BvhNode;

typedef struct {
    BvhNode *nodes;                  // the root first; some entries are unused
    uint32_t *order;                 // the triangles' numbers, leaf after leaf
    uint32_t *upper;                 // the inner nodes above the subtrees, ascending
    uint32_t node_count, leaf_count; // in use
    uint32_t upper_count;
    uint32_t largest_leaf, depth; // levels; at most BVH_MAX_DEPTH
} Bvh;

// Builds the tree. Without triangles it has no nodes.
bool bvh_build(Bvh *bvh, const Triangles *triangles, const BvhSettings *settings, ThreadPool *pool,
               Error *error);
void bvh_free(Bvh *bvh);

// Counts the inner nodes at every depth. counts[0] is the root's level.
void bvh_count_levels(const Bvh *bvh, uint32_t counts[BVH_MAX_DEPTH]);
