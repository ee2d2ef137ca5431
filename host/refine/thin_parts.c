// SPDX-License-Identifier: MIT
// Only pixels with a slot have room for cells, and only at the levels that are searched.
#include "refine/thin_cells.h"

#include <stdlib.h>
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

// Makes room for all slots at the levels that the sample budget covers.
static bool complete_room(ThinParts *parts, Error *error)
{
    parts->levels = parts->cuts[0] > 0 ? thin_parts_affordable(parts) : 0;
    for (uint32_t level = 0; level < parts->levels; level++)
        if (!thin_parts_make_room(parts, level, error))
            return false;
    return true;
}

bool thin_parts_make(ThinParts *parts, const ThinSource *source, Error *error)
{
    const FrameData *frame = source->frame;
    const size_t pixels = (size_t)frame->width * frame->height;
    *parts = (ThinParts){.width = frame->width, .height = frame->height, .most = source->levels};
    parts->slots = memory_zeroed(pixels, sizeof *parts->slots, error);
    bool ok = parts->slots != NULL;
    // With max_level 0, camera rays see only the background.
    if (ok && frame->max_level > 0)
        ok = thin_spheres_find(parts, source, error) && thin_triangles_find(parts, source, error);
    ok = ok && complete_room(parts, error);
    if (!ok)
        thin_parts_free(parts);
    return ok;
}

void thin_parts_free(ThinParts *parts)
{
    for (uint32_t level = 0; level < REFINE_LEVELS; level++)
        free(parts->rows[level].data);
    free(parts->slots);
    *parts = (ThinParts){0};
}
