// SPDX-License-Identifier: MIT
// Finds the cells to subdivide so that samples hit triangles thinner than a pixel, regardless of
// contrast.
//
// A triangle is thin at a level if no disk with the cells' diagonal as diameter fits into it. Every
// cell of that level that a thin triangle touches is subdivided, unless the triangle's mesh piece
// is wide at the cell. A piece is wide at a cell if it contains all four samples around some corner
// of the cell or of an adjacent cell. Such a piece is at least as wide as a cell, and contrast
// finds its outline.
//
// A sample therefore hits each triangle whose incircle is at least 1/57 pixel across, except
// - triangles within two pixels of a wider part of the same piece, and at deeper levels within two
//   cells of it;
// - hidden triangles, on which samples are wasted;
// - triangles visible only in mirrors or by their shadows;
// - the thinnest triangles, if all subdivisions together would take more than THIN_SAMPLES samples
//   per pixel of the picture. The deepest levels are then omitted.
#pragma once

#include "base/parallel.h"
#include "refine/cell_set.h"
#include "refine/refine_tree.h"
#include "scene/normalize.h"

#define THIN_SAMPLES 16

// Must not be moved or copied, because the sets in cut point to slots.
typedef struct {
    Slots slots;
    CellSet cut[REFINE_LEVELS]; // cells to subdivide, by level
    uint32_t levels;            // levels with subdivisions
} ThinParts;

// The input of the search.
typedef struct {
    const FrameData *frame; // its camera is made for REFINE_GRID samples
    const Scene *scene;
    const Normalization *normalization; // of the scene
    Crew *crew;                         // to share the work, NULL for none
} ThinSource;

bool thin_parts_make(ThinParts *parts, const ThinSource *source, Error *error);
void thin_parts_free(ThinParts *parts);

// Returns whether the cell of a level at that place must be subdivided. The unit of place is a cell
// of the last level.
static inline bool thin_parts_cut(const ThinParts *parts, const uint32_t place[2], uint32_t level)
{
    const uint32_t side = refine_tree_cell_side(level);
    return level < parts->levels &&
           cell_set_has(&parts->cut[level], place[0] / side, place[1] / side);
}

// Returns a mask of 32 pixels of a row from column left on, a multiple of 32. Set bits mark pixels
// to subdivide.
static inline uint32_t thin_parts_pixels(const ThinParts *parts, uint32_t left, uint32_t row)
{
    return parts->levels == 0 ? 0 : pixel_set_bits(&parts->cut[0], left, row);
}

// Returns a bit for each cell of a group that must be subdivided.
unsigned thin_parts_marks(const ThinParts *parts, const CellGroup *group);
