// SPDX-License-Identifier: MIT
// The samples of a picture whose pixels are refined where that pays.  A cell is a square with a
// sample at its middle: a pixel is one, and refining a cell cuts it into a group of 3 x 3, of which
// the middle keeps the sample it has.  So sets of samples are nested, and none is thrown away.
#pragma once

#include "image/framebuffer.h"
#include "refine/seam.h"

#define REFINE_LEVELS 4  // how often a cell of a pixel's size can be cut
#define REFINE_GRID   81 // cells of the last level along a pixel's side
#define GROUP_MIDDLE  4

#define REFINE_PIXELS_MOST ((uint64_t)1 << 31)

typedef enum { SIDE_LEFT, SIDE_RIGHT, SIDE_ABOVE, SIDE_BELOW, SIDE_COUNT } CellSide;

// Cells are numbered row by row.
typedef struct {
    uint32_t x, y;                 // of its middle, in cells of the last level
    uint32_t level;                // of its cells, from 1
    SampleData beyond[SIDE_COUNT]; // from the next cells of the size that was cut, or larger ones
    uint8_t beyond_levels[SIDE_COUNT]; // of those; of the size that was cut where there are none
    SampleData cells[GROUP_CELLS];
    uint32_t groups[GROUP_CELLS]; // that its cells are cut into, 0 where they are not
    uint32_t seams;               // the first, 0 for none
    float contrasts[GROUP_CELLS]; // of its cells, as contrast_read reads them
    float across[SIDE_COUNT];     // of the cells beyond, with those of the group beside them
} CellGroup;

typedef struct {
    uint32_t width, height, columns; // the last of blocks
    SampleData *pixels;              // in blocks of PACKET_SIDE x PACKET_SIDE, row by row
    uint32_t *pixel_groups;          // in rows; 0 where the pixel is not cut
    uint32_t *pixel_seams;           // in rows; the first of a pixel that is not, 0 for none
    ARRAY(CellGroup) groups;         // from 1
    ARRAY(Seam) seams;               // from 1
    uint32_t traced;                 // groups below have all their samples
} RefineTree;

// A tree with nothing seen yet; false where it has more than REFINE_PIXELS_MOST pixels, too.
bool refine_tree_make(RefineTree *tree, uint32_t width, uint32_t height, Error *error);
void refine_tree_free(RefineTree *tree);

// Elements of pixels: blocks may reach beyond the picture.
static inline uint32_t refine_tree_places(const RefineTree *tree)
{
    const uint32_t rows = (tree->height + PACKET_SIDE - 1) / PACKET_SIDE;
    return tree->columns * rows * PACKET_SIDE * PACKET_SIDE;
}

// The place of a pixel in pixels.
static inline uint32_t refine_tree_place(const RefineTree *tree, uint32_t x, uint32_t y)
{
    const uint32_t block = y / PACKET_SIDE * tree->columns + x / PACKET_SIDE;
    return block * (PACKET_SIDE * PACKET_SIDE) + y % PACKET_SIDE * PACKET_SIDE + x % PACKET_SIDE;
}

// A cell by its group, or a pixel by group 0 and its number in rows.
typedef struct {
    uint32_t group, cell, level;
} CellName;

// The cell that is not cut next to the one that a group cuts, and no smaller; false where there is
// none.  Cells that are not traced are none: what is cut of them would keep a sample never taken.
bool refine_tree_neighbor(const RefineTree *tree, const CellGroup *group, CellSide side,
                          CellName *name);
const SampleData *refine_tree_sample(const RefineTree *tree, const CellName *name);

// The sample of the smallest cell at a place of the picture.
const SampleData *refine_tree_sample_at(const RefineTree *tree, const uint32_t place[2]);

// Cuts a pixel, or a cell of a group: appends the group, of which the middle alone is known.
bool refine_tree_cut_pixel(RefineTree *tree, uint32_t x, uint32_t y, Error *error);
bool refine_tree_cut_cell(RefineTree *tree, uint32_t group, uint32_t cell, Error *error);

// Opens the seams of a pixel between what it and its neighbors saw, along the axis on which more
// differs.
bool refine_tree_open_pixel(RefineTree *tree, uint32_t x, uint32_t y, Error *error);

// Forgets the groups from `first` on, none of which has been cut.
void refine_tree_uncut(RefineTree *tree, uint32_t first);

// Cells of the last level along the side of a level's.
static inline uint32_t refine_tree_cell_side(uint32_t level)
{
    static const uint32_t sides[REFINE_LEVELS + 1] = {81, 27, 9, 3, 1};
    return sides[level];
}

// Where the sample of a group's cell lies, in cells of the last level.
void refine_tree_cell_place(const CellGroup *group, uint32_t cell, uint32_t place[2]);

// How many samples a pixel has.
uint32_t refine_tree_count(const RefineTree *tree, uint32_t x, uint32_t y);

// What each of a group's cells is known to hold, seams included, but for what they are cut into.
void refine_tree_cells(const RefineTree *tree, const CellGroup *group, ColorSum sums[GROUP_CELLS]);

// The mean over the samples of what a group cuts, weighted by their cells.
void refine_tree_mean(const RefineTree *tree, uint32_t group, float mean[3]);

// The same of a row of pixels, weighted by their cells.
void refine_tree_store_row(const RefineTree *tree, uint32_t y, float (*colors)[3]);
