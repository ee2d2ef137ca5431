// SPDX-License-Identifier: MIT
// Estimates the remaining error of cells from samples and their neighbors: contrast in the cell
// times the cell's fraction of the pixel. A linear slope has no contrast, since its mean is the
// center.
#pragma once

#include "refine/refine_tree.h"

#include <math.h>

// The weight of a color step between pixels on different surfaces. Their colors may be similar by
// chance, although an outline runs between them.
#define CONTRAST_OUTLINE_WEIGHT 2

// A step has a seam that locates it, so that less of its contrast remains.
typedef struct {
    float value;
    bool is_step;
} CellContrast;

// Contrasts are stored as floats; steps are negative.
static inline CellContrast contrast_read(float kept)
{
    return (CellContrast){fabsf(kept), signbit(kept) != 0};
}

static inline float contrast_kept(CellContrast contrast)
{
    return contrast.is_step ? -contrast.value : contrast.value;
}

// Returns the remaining contrast of a pixel's steps once its seams are located.
float contrast_past_seams(float contrast);

// Returns the contrast of a cell beside a group, across their common side. It is 0 if all samples
// along the side see the same surface.
float contrast_across(const CellGroup *group, CellSide side, const SampleData *other,
                      uint32_t level);

// Stores the contrasts of a group that has its samples: of its cells, subdivided or not, and of the
// cells beyond its sides at the time the group was created.
void contrast_keep(CellGroup *group);
