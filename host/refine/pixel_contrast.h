// SPDX-License-Identifier: MIT
// Computes the contrast of every pixel from the samples at pixel centers. Refinement does not
// change these samples, so the contrasts stay valid.
#pragma once

#include "base/parallel.h"
#include "refine/contrast.h"

// Contrasts row by row, as stored by contrast_kept().
typedef struct {
    uint32_t width;
    float *values;
} PixelContrasts;

// Computes the contrasts. Weights color steps between different surfaces by
// CONTRAST_OUTLINE_WEIGHT.
bool pixel_contrasts_make(PixelContrasts *contrasts, const RefineTree *tree, Crew *crew,
                          Error *error);
void pixel_contrasts_free(PixelContrasts *contrasts);

static inline CellContrast pixel_contrast(const PixelContrasts *contrasts, uint32_t x, uint32_t y)
{
    return contrast_read(contrasts->values[(size_t)y * contrasts->width + x]);
}
