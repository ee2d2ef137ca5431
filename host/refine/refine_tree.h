// SPDX-License-Identifier: MIT
// A picture's samples in a tree of cells. A cell is a square with a sample at its center, for
// example a pixel. Refinement subdivides a cell into a group of 3 x 3 cells. The middle cell keeps
// the sample, so no sample is wasted. In a group of 2 x 2 cells, no center would coincide with the
// old one.
//
// Four levels divide a pixel into 81 x 81 cells. A place is a position, counted in cells of the
// last level. All places are integers, so cells of different levels find their neighbors exactly.
//
// Invariant: a pixel's color is a sum of integers over its cells. Its bits depend on which samples
// exist, and not on the order in which they were taken.
#pragma once

#include "base/array.h"
#include "refine/seam.h"

#define REFINE_PIXELS_MOST ((uint64_t)1 << 31)

// A group of 3 x 3 cells, numbered row by row.
typedef struct {
    uint32_t x, y;  // of the center, in cells of the last level
    uint32_t level; // of the cells, from 1
    SampleData cells[GROUP_CELLS];
    uint32_t groups[GROUP_CELLS]; // the groups that subdivide the cells; 0: not subdivided
    uint32_t seams;               // the first seam; 0 for none
} CellGroup;

typedef struct {
    uint32_t width, height, columns; // columns of blocks
    SampleData *pixels;              // in blocks of PACKET_SIDE x PACKET_SIDE, row by row
    uint32_t *pixel_groups;          // row by row; 0 if the pixel is not subdivided
    ARRAY(CellGroup) groups;         // from index 1
    ARRAY(Seam) seams;               // from index 1
} RefineTree;

// Makes a tree without samples. Fails if the picture has more than REFINE_PIXELS_MOST pixels.
bool refine_tree_make(RefineTree *tree, uint32_t width, uint32_t height, Error *error);
void refine_tree_free(RefineTree *tree);

// Returns the number of elements of tree->pixels. Blocks may extend beyond the picture.
static inline uint32_t refine_tree_places(const RefineTree *tree)
{
    const uint32_t rows = (tree->height + PACKET_SIDE - 1) / PACKET_SIDE;
    return tree->columns * rows * PACKET_SIDE * PACKET_SIDE;
}

// Returns the index of a pixel in tree->pixels.
static inline uint32_t refine_tree_place(const RefineTree *tree, uint32_t x, uint32_t y)
{
    const uint32_t block = y / PACKET_SIDE * tree->columns + x / PACKET_SIDE;
    return block * (PACKET_SIDE * PACKET_SIDE) + y % PACKET_SIDE * PACKET_SIDE + x % PACKET_SIDE;
}

// Identifies a cell by its group and its index in the group. Pixels have group 0 and are indexed
// row by row.
typedef struct {
    uint32_t group, cell, level;
} CellName;

// Finds the smallest cell at a place, which is given in cells of the last level. Returns false
// outside of the picture.
bool refine_tree_find(const RefineTree *tree, const uint32_t place[2], CellName *name);

const SampleData *refine_tree_sample(const RefineTree *tree, const CellName *name);

// Subdivides a cell, unless it is subdivided already. The new group's middle cell has the cell's
// sample, and the other cells have no samples yet.
bool refine_tree_cut(RefineTree *tree, const CellName *name, Error *error);

// Removes the groups from `first` on. None of their cells may be subdivided.
void refine_tree_uncut(RefineTree *tree, uint32_t first);

// Returns the side of a level's cells, in cells of the last level.
static inline uint32_t refine_tree_cell_side(uint32_t level)
{
    static const uint32_t sides[REFINE_LEVELS + 1] = {81, 27, 9, 3, 1};
    return sides[level];
}

// Computes the place of a cell's sample, in cells of the last level.
void refine_tree_cell_place(const CellGroup *group, uint32_t cell, uint32_t place[2]);

// Returns the number of samples of a pixel.
uint32_t refine_tree_count(const RefineTree *tree, uint32_t x, uint32_t y);

// Computes the mean colors of a row of pixels.
void refine_tree_store_row(const RefineTree *tree, uint32_t y, float (*colors)[3]);
