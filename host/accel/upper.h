// SPDX-License-Identifier: MIT
// The upper levels of a large tree: divides the triangles until few enough are left in each node
// that a thread can build what is below it alone.
#pragma once

#include "accel/build.h"
#include "base/parallel.h"

// Subtrees have no more triangles, but for those that nothing divides well.
#define SUBTREE_TRIANGLES 65536

typedef struct {
    ARRAY(uint32_t) nodes;     // that were divided, in this order
    ARRAY(BuildTask) subtrees; // what is left below them, the largest first
    ARRAY(BuildTask) tasks;    // nodes that are still to be divided
} Upper;

// Sorts the numbers in the tree's order so that each subtree's are together.  Upper is empty before
// and to be freed in either case.
bool upper_divide(Upper *upper, const Build *build, Crew *crew, Error *error);
void upper_free(Upper *upper);
