// SPDX-License-Identifier: MIT
// The cells of one pixel and of a margin around it, as a mask for each row. The masks show at which
// cells a mesh piece is thin or wide.
#pragma once

#include "refine/outline.h"
#include "refine/refine_tree.h"

// Whether a piece is wide at a cell depends on samples up to this many cells away.
#define MARGIN     2
#define LOCAL_ROWS (REFINE_GRID / 3 + 2 * MARGIN)

typedef struct {
    uint64_t sampled[LOCAL_ROWS]; // the piece contains the cell's sample
    uint64_t touched[LOCAL_ROWS]; // a thin triangle touches the cell
} LocalCells;

// Adds a triangle. The grid is the pixel's, with a margin of MARGIN cells.
void local_cells_add(LocalCells *cells, const Outline *outline, const CellGrid *grid,
                     uint32_t level);

// Returns a mask of a row's cells at which the piece is wide. The mask has no margin.
uint32_t local_cells_wide(const LocalCells *cells, uint32_t row);
