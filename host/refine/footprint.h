// SPDX-License-Identifier: MIT
// Spheres smaller than a pixel -> the cells to be cut so that a sample meets each, whatever the
// samples around it saw.
#pragma once

#include "refine/refine_tree.h"

// Where a small sphere appears in one pixel, in cells of the last level.
typedef struct {
    uint32_t pixel;     // row by row
    float x, y;         // its middle
    float inner, outer; // radii of a disk within its outline, and of one around it
} Footprint;

typedef struct {
    ARRAY(Footprint) list; // in the order of the pixels
    uint32_t width;        // of the picture
} Footprints;

// Projects the spheres that may lie between the samples of neighboring pixels.  The frame's camera
// is made for REFINE_GRID samples.
bool footprints_make(Footprints *footprints, const FrameData *frame, const SphereData *spheres,
                     Error *error);
void footprints_free(Footprints *footprints);

// The cells of a group that must be cut for spheres to be met: a bit for each.
unsigned footprints_marks(const Footprints *footprints, const CellGroup *group);
