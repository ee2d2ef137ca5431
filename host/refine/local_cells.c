// SPDX-License-Identifier: MIT
// Bit i of a mask with a margin stands for the pixel's cell i - MARGIN.
#include "refine/local_cells.h"

#include "refine/thin_cells.h"

static uint64_t mask_of(CellRange columns)
{
    return columns.first < columns.end
               ? ((uint64_t)1 << columns.end) - ((uint64_t)1 << columns.first)
               : 0;
}

void local_cells_add(LocalCells *cells, const Outline *outline, const CellGrid *grid,
                     uint32_t level)
{
    const bool thin = thin_at_level(outline, level);
    const CellRange rows = box_touched(&outline->box, grid, 1);
    for (uint32_t row = rows.first; row < rows.end; row++) {
        cells->sampled[row] |= mask_of(outline_sampled(outline, grid, row));
        if (thin)
            cells->touched[row] |= mask_of(outline_touched(outline, grid, row));
    }
}

uint32_t local_cells_wide(const LocalCells *cells, uint32_t row)
{
    uint64_t corners = 0;
    for (uint32_t above = row; above < row + 2 * MARGIN; above++) {
        const uint64_t both = cells->sampled[above] & cells->sampled[above + 1];
        corners |= both & both >> 1;
    }
    return (uint32_t)(corners | corners >> 1 | corners >> 2 | corners >> 3);
}
