// SPDX-License-Identifier: MIT
// Samples and their neighbors -> how far cells are from being known: the contrast in a cell times
// its part of the pixel.  A smooth slope has none, since a sample at the middle is its mean.
#pragma once

#include "refine/refine_tree.h"

#include <math.h>

// Of what a pixel and its neighbors saw: two may agree in color by chance where an outline runs
// between them.
#define CONTRAST_OUTLINE_WEIGHT 2

// Of one kind or the other as its neighbors show: colors that step say less of what is left.
typedef struct {
    float value;
    bool is_step;
} CellContrast;

// Contrasts are kept as floats, with a sign where they are of steps.
static inline CellContrast contrast_read(float kept)
{
    return (CellContrast){fabsf(kept), signbit(kept) != 0};
}

static inline float contrast_kept(CellContrast contrast)
{
    return contrast.is_step ? -contrast.value : contrast.value;
}

// What is left of a pixel's steps once its seams are placed.
float contrast_past_seams(float contrast);

// Of a cell beside a group, across the side that they share; zero where all that meets there saw
// the same.
float contrast_across(const CellGroup *group, CellSide side, const SampleData *other,
                      uint32_t level);

// Keeps those of a group that has its samples: of its cells, with no regard to which are cut, and
// of those beyond its sides as they were when it was made.
void contrast_keep(CellGroup *group);
