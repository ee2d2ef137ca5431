// SPDX-License-Identifier: MIT
// The cells around thin parts (thin_parts.h), level by level.
#pragma once

#include "base/thread_pool.h"
#include "refine/outline.h"
#include "refine/refine_tree.h"
#include "scene/normalize.h"

#define THIN_SAMPLES 16

typedef struct {
    uint32_t width, height;
    uint32_t *slots;                     // of pixels, row by row; 0: no thin part
    uint32_t count;                      // of slots; slots are numbered from 1
    ARRAY(uint32_t) rows[REFINE_LEVELS]; // by level, then slot: a mask of cells for each row
    uint64_t cuts[REFINE_LEVELS];        // cells to subdivide, by level
    uint32_t most;                       // number of levels to search
    uint32_t levels;                     // number of levels at which cells are subdivided
} ThinParts;

// The input of the search.
typedef struct {
    const FrameData *frame; // its camera is made for REFINE_GRID samples
    const Scene *scene;
    const Normalization *normalization; // of the scene
    const SphereData *spheres;          // of the frame
    ThreadPool *pool;                   // threads for the work, NULL for none
    uint32_t levels;                    // to search, from 1 to REFINE_LEVELS
} ThinSource;

// Returns whether a thin part touches the pixel.
static inline bool thin_parts_touch(const ThinParts *parts, uint32_t pixel)
{
    return parts->slots[pixel] != 0;
}

// Returns the number of a level's cells along a pixel's side.
static inline uint32_t thin_parts_scale(uint32_t level)
{
    return REFINE_GRID / refine_tree_cell_side(level);
}

// Returns whether the cell of a level at that place must be subdivided. The unit of place is a cell
// of the last level.
static inline bool thin_parts_cut(const ThinParts *parts, const uint32_t place[2], uint32_t level)
{
    const uint32_t side = refine_tree_cell_side(level), scale = thin_parts_scale(level);
    if (level >= parts->levels)
        return false;
    const uint32_t slot =
        parts->slots[(size_t)(place[1] / REFINE_GRID) * parts->width + place[0] / REFINE_GRID];
    return slot != 0 && (parts->rows[level].data[(size_t)slot * scale + place[1] / side % scale] >>
                             (place[0] / side % scale) &
                         1) != 0;
}

// Returns whether the outline is thin at a level (thin_parts.h).
static inline bool thin_at_level(const Outline *outline, uint32_t level)
{
    return outline_is_thinner(outline, 1.41421356 * refine_tree_cell_side(level));
}

// Gives a pixel a slot, unless it has one.
void thin_parts_add_pixel(ThinParts *parts, uint32_t pixel);

// Makes room for the cells of all slots at a level.
bool thin_parts_make_room(ThinParts *parts, uint32_t level, Error *error);

// Returns the masks of a pixel's rows at a level. The pixel must have a slot with room.
uint32_t *thin_parts_rows(const ThinParts *parts, uint32_t pixel, uint32_t level);

// Adds the cells of a mask to a row. Returns the number of new cells.
uint32_t thin_row_add(uint32_t *row, uint32_t mask);

// Returns the number of levels that the sample budget covers.
uint32_t thin_parts_affordable(const ThinParts *parts);

// Returns the cells of a pixel at a level, and `margin` cells around them.
CellGrid thin_parts_grid(const ThinParts *parts, uint32_t pixel, uint32_t level, uint32_t margin);

// local_cells_wide tests a cell by samples up to this many cells away.
#define MARGIN     2
#define LOCAL_ROWS (REFINE_GRID / 3 + 2 * MARGIN)

// The cells of one pixel and of a margin around it, as a mask for each row. The masks show at which
// cells a mesh piece is thin or wide.
typedef struct {
    uint64_t sampled[LOCAL_ROWS]; // the piece contains the cell's sample
    uint64_t touched[LOCAL_ROWS]; // a thin triangle touches the cell
} LocalCells;

// Adds a triangle. `grid` consists of the pixel's cells and a margin of MARGIN cells.
void local_cells_add(LocalCells *cells, const Outline *outline, const CellGrid *grid,
                     uint32_t level);

// Returns a mask of a row's cells at which the piece is wide. The mask has no margin.
uint32_t local_cells_wide(const LocalCells *cells, uint32_t row);
