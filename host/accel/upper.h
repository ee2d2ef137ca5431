// SPDX-License-Identifier: MIT
// Builds the upper levels of a large tree: divides the triangles until one thread can build each
// remaining subtree.
#pragma once

#include "accel/build.h"
#include "base/parallel.h"

// Subtrees have at most this many triangles, unless no grid divides them well.
#define SUBTREE_TRIANGLES 65536

typedef struct {
    ARRAY(uint32_t) nodes;     // divided nodes, in the order of division
    ARRAY(BuildTask) subtrees; // remaining subtrees, the largest first
    ARRAY(BuildTask) tasks;    // nodes that are not divided yet
} Upper;

// Divides the tree's triangles into subtrees, and sorts Bvh::order so that each subtree's triangles
// are adjacent. upper must be empty. The caller frees it on success and on failure.
bool upper_divide(Upper *upper, const Build *build, Crew *crew, Error *error);
void upper_free(Upper *upper);
