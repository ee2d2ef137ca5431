// SPDX-License-Identifier: MIT
// A refined picture -> what cutting its cells has changed, and what is left to cut: from these
// follow how far it is from a picture of endless samples, and what getting nearer takes.
#pragma once

#include "render/adaptive.h"

// Contrasts are counted by powers of 2^(1/4) below CONTRAST_MOST.
#define CONTRAST_BINS 128
#define CONTRAST_MOST 8

typedef struct {
    // Sums of squares over the cells of each level: contrast of those that are cut, of those that
    // are not, and what cutting changed, as the part of a pixel.
    double cut[REFINE_LEVELS + 1], left[REFINE_LEVELS + 1], changed[REFINE_LEVELS + 1];
    uint64_t cuts[REFINE_LEVELS + 1]; // cells that are cut
    uint64_t counts[CONTRAST_BINS];   // of cells that can be cut, by contrast, the highest first
    double pixels;
} CellSums;

bool cell_sums_make(CellSums *sums, const Adaptive *adaptive, Error *error);

// The estimated root mean square error over all values of the picture.
double cell_sums_error(const CellSums *sums);

// A threshold that at most so many cells, of those that can be cut, are above; 0 where all may.
float cell_sums_threshold(const CellSums *sums, double cells);
