// SPDX-License-Identifier: MIT
// Finds the cells to subdivide so that a sample hits each sphere smaller than a pixel, regardless
// of contrast.
#pragma once

#include "refine/refine_tree.h"

// The projection of a small sphere in one pixel, in cells of the last level.
typedef struct {
    uint32_t pixel;     // row by row
    float x, y;         // of the center
    float inner, outer; // radii of disks inside and around its outline
} Footprint;

typedef struct {
    ARRAY(Footprint) list; // in the order of the pixels
    uint32_t width;        // of the picture
} Footprints;

// Projects the spheres that fit between the samples of neighboring pixels. The frame's camera must
// be made for REFINE_GRID samples.
bool footprints_make(Footprints *footprints, const FrameData *frame, const SphereData *spheres,
                     Error *error);
void footprints_free(Footprints *footprints);

// Returns a bit for each cell of a group that must be subdivided to hit a sphere.
unsigned footprints_marks(const Footprints *footprints, const CellGroup *group);
