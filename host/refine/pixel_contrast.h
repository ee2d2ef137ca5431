// SPDX-License-Identifier: MIT
// The first sample of every pixel -> how far each pixel is from being known, kept for as long as
// the picture is refined: neighbors of pixels never change.
#pragma once

#include "base/thread_pool.h"
#include "refine/contrast.h"

// In rows, as contrast_read reads them.
typedef struct {
    uint32_t width;
    float *values;
} PixelContrasts;

// What differs from a neighbor that met another surface or light counts twice.
bool pixel_contrasts_make(PixelContrasts *contrasts, const RefineTree *tree, ThreadPool *pool,
                          Error *error);
void pixel_contrasts_free(PixelContrasts *contrasts);

static inline CellContrast pixel_contrast(const PixelContrasts *contrasts, uint32_t x, uint32_t y)
{
    return contrast_read(contrasts->values[(size_t)y * contrasts->width + x]);
}
