// SPDX-License-Identifier: MIT
// Triangles thinner than a pixel -> the cells to be cut so that samples meet them, whatever the
// samples around them saw.
//
// A triangle is thin at a level of cells where no disk of the cells' diagonal fits into it.  Every
// cell of that level that a thin triangle touches is cut, unless its piece of the mesh holds the
// samples of four cells around a corner, of that cell or of one beside it: there the piece is no
// thinner than the cells, and what differs from it is found by contrast.  So each triangle whose
// inner disk is a 57th of a pixel across or more is met by a sample that looks for it, but for
// those
// - within two pixels of a part of their own piece that is wider than a pixel, and so at each
// level;
// - hidden by others: they are looked for all the same, and in vain;
// - seen in mirrors or by their shadows alone;
// - of levels left out because all cuts to that depth would take more samples than THIN_SAMPLES a
//   pixel of the picture: the deepest go first.
#pragma once

#include "base/thread_pool.h"
#include "refine/cell_set.h"
#include "refine/refine_tree.h"
#include "scene/normalize.h"

#define THIN_SAMPLES 16

// It stays where it was made.
typedef struct {
    Slots slots;
    CellSet cut[REFINE_LEVELS]; // cells by level
    uint32_t levels;            // that are cut at all
} ThinParts;

// What they are looked for in.
typedef struct {
    const FrameData *frame; // its camera is made for REFINE_GRID samples
    const Scene *scene;
    const Normalization *normalization; // of the scene
    ThreadPool *pool;                   // to share the work, NULL for none
} ThinSource;

bool thin_parts_make(ThinParts *parts, const ThinSource *source, Error *error);
void thin_parts_free(ThinParts *parts);

// Whether the cell of a level around that place, in cells of the last level, must be cut.
static inline bool thin_parts_cut(const ThinParts *parts, const uint32_t place[2], uint32_t level)
{
    const uint32_t side = refine_tree_cell_side(level);
    return level < parts->levels &&
           cell_set_has(&parts->cut[level], place[0] / side, place[1] / side);
}

// The same of 32 pixels of a row from `left` on, a multiple of 32: a bit for each.
static inline uint32_t thin_parts_pixels(const ThinParts *parts, uint32_t left, uint32_t row)
{
    return parts->levels == 0 ? 0 : pixel_set_bits(&parts->cut[0], left, row);
}

// The cells of a group that must be cut: a bit for each.
unsigned thin_parts_marks(const ThinParts *parts, const CellGroup *group);
