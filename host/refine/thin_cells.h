// SPDX-License-Identifier: MIT
// The construction of ThinParts, shared by the searches for triangles and spheres.
#pragma once

#include "refine/outline.h"
#include "refine/thin_parts.h"

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

// Adds the cells around spheres with a diameter below the cells' diagonal.
bool thin_spheres_find(ThinParts *parts, const ThinSource *source, Error *error);

// Adds the cells around thin parts of meshes.
bool thin_triangles_find(ThinParts *parts, const ThinSource *source, Error *error);
