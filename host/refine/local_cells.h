// SPDX-License-Identifier: MIT
// The cells of one pixel and of a margin around it, as a mask for each row. Finds the cells at
// which the triangles of a mesh piece are thin or wide.
#pragma once

#include "refine/outline.h"
#include "refine/refine_tree.h"

// A cell is examined with the samples of this many cells around it.
#define MARGIN     2
#define LOCAL_ROWS (REFINE_GRID / 3 + 2 * MARGIN)

typedef struct {
    uint64_t sampled[LOCAL_ROWS]; // the piece contains the cell's sample
    uint64_t touched[LOCAL_ROWS]; // a thin triangle touches the cell
} LocalCells;

// Adds a triangle. The grid is the pixel's, with a margin of MARGIN cells.
void local_cells_add(LocalCells *cells, const Outline *outline, const CellGrid *grid,
                     uint32_t level);

// Returns the cells of a row, without its margin, at which the piece is wide.
uint32_t local_cells_wide(const LocalCells *cells, uint32_t row);
