// SPDX-License-Identifier: MIT
// Builds the upper levels of a large tree: divides the triangles until one thread can build each
// remaining subtree.
#pragma once

#include "accel/build.h"
#include "base/thread_pool.h"

// Subtrees have at most this many triangles, unless no grid divides them well.
#define SUBTREE_TRIANGLES 65536

typedef struct {
    ARRAY(uint32_t) nodes;     // divided nodes, in the order of division
    ARRAY(BuildTask) subtrees; // remaining subtrees, the largest first
    ARRAY(BuildTask) tasks;    // nodes that are not divided yet
} Upper;

// Divides the tree's triangles into subtrees, and sorts Bvh::order so that each subtree's triangles
// are adjacent. upper must be empty. The caller frees it on success and on failure.
bool upper_divide(Upper *upper, const Build *build, ThreadPool *pool, Error *error);
void upper_free(Upper *upper);

// Sorts triangles into the cells of a grid. A builder can then divide a large node through many
// levels by moving cells instead of triangles.
typedef struct {
    BuildItem *items;  // bounds, index and triangle count of each nonempty cell
    uint32_t *starts;  // by cell: where its triangles begin in numbers; then the end of numbers
    uint32_t *numbers; // triangle indices, cell by cell
    uint32_t count;
} Cells;

// The triangles to sort, by index.
typedef struct {
    const Triangles *triangles;
    const uint32_t *numbers;
    uint32_t count;
} CellSource;

// Makes the cells. Within a cell, triangles keep the order of source. If all centers are equal, one
// cell holds all triangles.
bool cells_make(Cells *cells, const CellSource *source, ThreadPool *pool, Error *error);
void cells_free(Cells *cells);
