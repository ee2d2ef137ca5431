// SPDX-License-Identifier: MIT
// A refined picture -> what cutting its cells has changed, and what is left to cut: from these
// follow how far it is from a picture of endless samples, and what getting nearer takes.
#pragma once

#include "render/adaptive.h"

// Contrasts are counted by quarters of powers of two.
#define CONTRAST_BINS 128

// Sums of squares over the cells of a level and kind: contrast of those that are cut, of those that
// are not, and what cutting changed, as the part of a pixel.
typedef struct {
    double cut, left, changed;
    uint64_t cuts; // cells that are cut
} KindSums;

typedef struct {
    KindSums bends[REFINE_LEVELS + 1], steps[REFINE_LEVELS + 1];
    double seams;                   // expected squares of errors where they may lie
    uint64_t counts[CONTRAST_BINS]; // of samples to take, by contrast, the highest first
    double pixels;
} CellSums;

bool cell_sums_make(CellSums *sums, const Adaptive *adaptive, Error *error);

// The estimated root mean square error over all values of the picture.
double cell_sums_error(const CellSums *sums);

// A threshold for which a pass takes at most so many samples; 0 where it may take all.
float cell_sums_threshold(const CellSums *sums, double samples);
