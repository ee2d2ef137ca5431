// SPDX-License-Identifier: MIT
// Samples and their neighbors -> how far cells are from being known: the contrast in a cell times
// its part of the pixel.  A smooth slope has none, since a sample at the middle is its mean.
#pragma once

#include "render/refine_tree.h"

// Of a pixel; *is_edge tells whether a neighbor met another surface or light.
float contrast_of_pixel(const RefineTree *tree, uint32_t x, uint32_t y, bool *is_edge);

// Of a cell beside a group, across the side that they share; zero where all that meets there saw
// the same.  *is_edge tells whether it did not.
float contrast_across(const CellGroup *group, CellSide side, const SampleData *other,
                      uint32_t level, bool *is_edge);

// Of a group's cells, with no regard to which are cut.
void contrast_of_group(const CellGroup *group, float contrast[GROUP_CELLS]);
