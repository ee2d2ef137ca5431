// SPDX-License-Identifier: MIT
// The upper levels of a large tree: divides the triangles until each node has few enough for one
// thread.
#pragma once

#include "accel/build.h"
#include "base/thread_pool.h"

// Subtrees have at most this many triangles, except those that nothing divides well.
#define SUBTREE_TRIANGLES 65536

typedef struct {
    ARRAY(uint32_t) nodes;     // divided nodes, in this order
    ARRAY(BuildTask) subtrees; // remaining subtrees, the largest first
    ARRAY(BuildTask) tasks;    // nodes that are still to be divided
} Upper;

// Sorts the numbers in the tree's order so that each subtree's are adjacent. upper must be empty.
// The caller frees it in both cases.
bool upper_divide(Upper *upper, const Build *build, ThreadPool *pool, Error *error);
void upper_free(Upper *upper);
