// SPDX-License-Identifier: MIT
// Spheres smaller than a pixel -> the cells to be cut so that a sample meets each, whatever the
// samples around it saw.
#pragma once

#include "render/refine_tree.h"

// Where a small sphere appears in one pixel, in cells of the last level.
typedef struct {
    uint32_t pixel;     // row by row
    float x, y;         // its middle
    float inner, outer; // radii of a disk within its outline, and of one around it
} Footprint;

typedef struct {
    ARRAY(Footprint) list; // in the order of the pixels
} Footprints;

// Projects the spheres that may lie between the samples of neighboring pixels.  The frame's camera
// is made for REFINE_GRID samples.
bool footprints_make(Footprints *footprints, const FrameData *frame, const SphereData *spheres,
                     Error *error);
void footprints_free(Footprints *footprints);

// Those in a pixel: the first, and one past the last.
void footprints_of_pixel(const Footprints *footprints, uint32_t pixel, const Footprint *range[2]);

// Whether a cell, of that side and with that middle, must be cut for a sphere to be met.
bool footprint_cuts(const Footprint *footprint, const uint32_t middle[2], uint32_t side);
