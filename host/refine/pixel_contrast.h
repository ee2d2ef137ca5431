// SPDX-License-Identifier: MIT
// Computes the contrast of every pixel from the samples at pixel centers. Refinement does not
// change these samples, so the contrasts stay valid.
#pragma once

#include "base/thread_pool.h"
#include "refine/refine_tree.h"

#include <math.h>

// Estimates the remaining error of a cell from its sample and neighboring samples: contrast times
// the cell's fraction of the pixel. Colors that vary linearly have no contrast, because the center
// sample equals their mean.

// The weight of a color step between pixels on different surfaces. Their colors may be similar by
// chance, although an outline runs between them.
#define CONTRAST_OUTLINE_WEIGHT 2

// If is_step, the color changes abruptly. A seam then locates the step, so that less contrast
// remains.
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

// Returns the contrast that remains of a pixel's step after its seams are located.
float contrast_past_seams(float contrast);

// Returns the contrast between a group and the cell beyond a side. other is that cell's sample,
// level its level. The contrast is 0 if all samples along the side see the same surface.
float contrast_across(const CellGroup *group, CellSide side, const SampleData *other,
                      uint32_t level);

// Computes group->contrasts and group->across. The group must have all its samples. Later
// subdivisions do not change the results.
void contrast_keep(CellGroup *group);

// Contrasts row by row, as stored by contrast_kept().
typedef struct {
    uint32_t width;
    float *values;
} PixelContrasts;

// Computes the contrasts. Weights color steps between different surfaces by
// CONTRAST_OUTLINE_WEIGHT.
bool pixel_contrasts_make(PixelContrasts *contrasts, const RefineTree *tree, ThreadPool *pool,
                          Error *error);
void pixel_contrasts_free(PixelContrasts *contrasts);

static inline CellContrast pixel_contrast(const PixelContrasts *contrasts, uint32_t x, uint32_t y)
{
    return contrast_read(contrasts->values[(size_t)y * contrasts->width + x]);
}
