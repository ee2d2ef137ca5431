// SPDX-License-Identifier: MIT
// Builds a Bvh from triangles: a binary tree of boxes with triangles in its leaves (Rubin and
// Whitted, "A 3-dimensional representation for fast rendering of complex scenes", 1980). The number
// of threads does not affect the tree.
#pragma once

#include "accel/bvh_tree.h"
#include "accel/triangles.h"

// Builds the tree. It has no nodes if there are no triangles.
bool bvh_build(Bvh *bvh, const Triangles *triangles, const BvhSettings *settings, ThreadPool *pool,
               Error *error);
void bvh_free(Bvh *bvh);

typedef struct {
    const Box *boxes; // no coordinate is NaN
    uint32_t count;
} BoxArray;

// Builds a tree over boxes instead of triangles.
bool bvh_build_boxes(Bvh *bvh, const BoxArray *boxes, const BvhSettings *settings, ThreadPool *pool,
                     Error *error);
