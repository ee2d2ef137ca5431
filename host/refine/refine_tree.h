// SPDX-License-Identifier: MIT
// A picture's samples in a tree of cells. A cell is a square with a sample at its center, for
// example a pixel. Refinement subdivides a cell into a group of 3 x 3 cells. The middle cell keeps
// the sample, so that no sample is wasted.
#pragma once

#include "base/thread_pool.h"
#include "image/framebuffer.h"
#include "scene/scene.h"

#include <math.h>
#include <stdbool.h>

// A seam is the place where a line of samples crosses from one surface to another. Bisection
// locates it with one sample per bit; subdividing cells takes eight samples for 1.6 bits.

#define GROUP_SIDE  3
#define GROUP_CELLS 9

typedef enum { SEAM_END_FIRST, SEAM_END_LAST, SEAM_ENDS } SeamEnd;

// A line crosses three cells of a group, or one pixel. Positions along the line are in cells of the
// last level.
typedef struct {
    SampleData ends[SEAM_ENDS]; // the samples at from and at to
    uint32_t x, y;              // start of the line
    uint32_t group, next;       // next seam of the group or pixel; 0 at the end
    uint8_t stride;             // from cell to cell: 1 along a row, GROUP_SIDE along a column
    uint8_t cells, side;        // the number of cells on the line, and the side of each cell
    uint8_t line;               // index in the group, 0 to 2
    uint8_t from, to;           // the interval to which the seam applies
    uint8_t low, high;          // positions of the nearest samples before and after the seam
    uint8_t assumed;            // the end with a sample from beyond the line, or SEAM_ENDS
    uint8_t samples;            // taken to locate the seam
} Seam;

// The samples of a line: its cells, and one beyond each end.
#define LINE_SAMPLES (GROUP_SIDE + 2)
#define LINE_GAPS    (LINE_SAMPLES - 1)

// Returns whether colors change abruptly in a gap between two samples of a line.
bool seam_steps(const SampleData *const line[LINE_SAMPLES], uint32_t gap);

// Returns the largest difference between two samples' color values.
static inline float seam_difference(const SampleData *one, const SampleData *other)
{
    float most = 0;
    for (int channel = 0; channel < 3; channel++) {
        const float difference = fabsf(one->color[channel] - other->color[channel]);
        most = difference > most ? difference : most;
    }
    return most;
}

// Returns the remaining error: contrast times the uncertain fraction of the pixel.
float seam_contrast(const Seam *seam);

// Returns whether another sample would narrow the interval, and where to take it.
bool seam_asks(const Seam *seam, uint32_t place[2]);

// Updates the seam with the requested sample. Returns whether the sample sees a third surface. In
// that case, the caller must add *rest as the next seam.
bool seam_take(Seam *seam, const SampleData *sample, Seam *rest);

// Discards the seam, which then corrects nothing.
void seam_close(Seam *seam);

// Colors in steps of 2^-32, multiplied by twice the cell's area.
typedef uint64_t ColorSum[3];

// Corrects the color sums of a group's cells, or of a pixel. Before, the sums must assume one color
// per cell.
void seam_correct(const Seam *seam, const SampleData cells[], ColorSum sums[]);

static inline uint64_t seam_color_steps(float color)
{
    return (uint64_t)(color * 0x1p32f);
}

#define REFINE_LEVELS 4  // the deepest level; pixels have level 0
#define REFINE_GRID   81 // cells of the last level along a pixel's side
#define GROUP_MIDDLE  4

#define REFINE_PIXELS_MOST ((uint64_t)1 << 31)

typedef enum { SIDE_LEFT, SIDE_RIGHT, SIDE_ABOVE, SIDE_BELOW, SIDE_COUNT } CellSide;

// Cells are numbered row by row.
typedef struct {
    uint32_t x, y;                     // of the center, in cells of the last level
    uint32_t level;                    // of the cells, from 1
    SampleData beyond[SIDE_COUNT];     // of the adjacent cells, as large as the group or larger
    uint8_t beyond_levels[SIDE_COUNT]; // levels of these cells; level - 1 outside of the picture
    SampleData cells[GROUP_CELLS];
    uint32_t groups[GROUP_CELLS]; // the groups that subdivide the cells; 0: not subdivided
    uint32_t seams;               // the first seam; 0 for none
    float contrasts[GROUP_CELLS]; // of the cells, as stored by contrast_kept()
    float across[SIDE_COUNT];     // contrasts between the group and the cells beyond
} CellGroup;

typedef struct {
    uint32_t width, height, columns; // columns of blocks
    SampleData *pixels;              // in blocks of PACKET_SIDE x PACKET_SIDE, row by row
    uint32_t *pixel_groups;          // row by row; 0 if the pixel is not subdivided
    uint32_t *pixel_seams;           // row by row; the first seam of each pixel, 0 for none
    ARRAY(CellGroup) groups;         // from index 1
    ARRAY(Seam) seams;               // from index 1
    uint32_t traced;                 // groups with a lower index have all their samples
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

// Identifies a cell by group and index, or a pixel by group 0 and its index row by row.
typedef struct {
    uint32_t group, cell, level;
} CellName;

// Finds the cell beyond a side of a group, as large as the group or larger. Returns false outside
// of the picture, or if the cell is subdivided. Never finds a cell whose sample is not taken yet,
// because subdivision keeps the sample.
bool refine_tree_neighbor(const RefineTree *tree, const CellGroup *group, CellSide side,
                          CellName *name);
const SampleData *refine_tree_sample(const RefineTree *tree, const CellName *name);

// Returns the sample of the smallest cell that contains a place.
const SampleData *refine_tree_sample_at(const RefineTree *tree, const uint32_t place[2]);

// Subdivide a pixel, or a cell of a group. They append a group in which only the middle cell has a
// sample.
bool refine_tree_cut_pixel(RefineTree *tree, uint32_t x, uint32_t y, Error *error);
bool refine_tree_cut_cell(RefineTree *tree, uint32_t group, uint32_t cell, Error *error);

// Opens seams between a pixel and its two neighbors along one axis: the axis with the larger color
// differences.
bool refine_tree_open_pixel(RefineTree *tree, uint32_t x, uint32_t y, Error *error);

// Removes the groups from first on. No removed cell may be subdivided.
void refine_tree_uncut(RefineTree *tree, uint32_t first);

// Returns the side of a cell of that level, in cells of the last level.
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

// Opens the seams of a refined picture, and lists the seams that need samples.

// The seams that need a sample.
typedef struct {
    ARRAY(uint32_t) asked; // indices in ascending order
    uint32_t seen;         // seams with a lower index are listed, or precise enough
} SeamSearch;

// Opens the seams of groups first to end - 1, which must have all their samples.
bool seam_search_open(RefineTree *tree, uint32_t first, uint32_t end, ThreadPool *pool,
                      Error *error);

// Lists the seams with a contrast above the threshold. Examines the listed seams and new seams.
bool seam_search_ask(SeamSearch *search, const RefineTree *tree, float threshold, Error *error);

// Updates the listed seams with their samples.
bool seam_search_take(const SeamSearch *search, RefineTree *tree, const SampleData *samples,
                      Error *error);

void seam_search_free(SeamSearch *search);
