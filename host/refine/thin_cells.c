// SPDX-License-Identifier: MIT
// Stores cells as a bit mask for each row of a pixel. Each pixel that a thin part touches has a
// number, its slot, by which its masks are found. Masks exist only at the levels that are searched.
// In a mask with a margin, bit i stands for the pixel's cell i - MARGIN.
#include "refine/thin_cells.h"

#include <string.h>

void thin_parts_add_pixel(ThinParts *parts, uint32_t pixel)
{
    uint32_t *slot = &parts->slots[pixel];
    if (*slot == 0)
        *slot = ++parts->count;
}

bool thin_parts_make_room(ThinParts *parts, uint32_t level, Error *error)
{
    const size_t count = ((size_t)parts->count + 1) * thin_parts_scale(level);
    if (!array_reserve(&parts->rows[level].memory, &parts->rows[level].capacity, count,
                       sizeof *parts->rows[level].data, error))
        return false;
    memset(parts->rows[level].data + parts->rows[level].count, 0,
           (count - parts->rows[level].count) * sizeof *parts->rows[level].data);
    parts->rows[level].count = count;
    return true;
}

uint32_t *thin_parts_rows(const ThinParts *parts, uint32_t pixel, uint32_t level)
{
    const uint32_t slot = parts->slots[pixel];
    return &parts->rows[level].data[(size_t)slot * thin_parts_scale(level)];
}

uint32_t thin_row_add(uint32_t *row, uint32_t mask)
{
    uint32_t count = 0;
    for (uint32_t added = mask & ~*row; added != 0; added &= added - 1)
        count++;
    *row |= mask;
    return count;
}

uint32_t thin_parts_affordable(const ThinParts *parts)
{
    const double most = (double)THIN_SAMPLES * parts->width * parts->height;
    double samples = 0;
    uint32_t level = 0;
    while (level < parts->most) {
        samples += (GROUP_CELLS - 1) * (double)parts->cuts[level];
        if (samples > most)
            break;
        level++;
    }
    return level;
}

CellGrid thin_parts_grid(const ThinParts *parts, uint32_t pixel, uint32_t level, uint32_t margin)
{
    const uint32_t side = refine_tree_cell_side(level),
                   count = thin_parts_scale(level) + 2 * margin;
    const double before = (double)side * margin;
    return (CellGrid){side,
                      1.0 / side,
                      {count, count},
                      {(double)(pixel % parts->width) * REFINE_GRID - before,
                       (double)(pixel / parts->width) * REFINE_GRID - before}};
}

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
