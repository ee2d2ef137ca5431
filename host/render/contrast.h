// SPDX-License-Identifier: MIT
// Samples and their neighbors -> how far cells are from being known: the contrast in a cell times
// its part of the pixel.  A smooth slope has none, since a sample at the middle is its mean.
#pragma once

#include "render/refine_tree.h"

// Of one kind or the other as its neighbors show: colors that step say less of what is left.
typedef struct {
    float value;
    bool is_step;
} CellContrast;

// Of a pixel; what differs from a neighbor that met another surface or light counts twice.
CellContrast contrast_of_pixel(const RefineTree *tree, uint32_t x, uint32_t y);

// What is left of a pixel's steps once its seams are placed.
float contrast_past_seams(float contrast);

// Whether that may be above a threshold: false for most pixels, at a fraction of the cost.
bool contrast_may_exceed(const RefineTree *tree, uint32_t x, uint32_t y, float threshold);

// Of a cell beside a group, across the side that they share; zero where all that meets there saw
// the same.
float contrast_across(const CellGroup *group, CellSide side, const SampleData *other,
                      uint32_t level);

// Of a group's cells, with no regard to which are cut.
void contrast_of_group(const CellGroup *group, CellContrast contrast[GROUP_CELLS]);
