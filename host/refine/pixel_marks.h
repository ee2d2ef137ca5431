// SPDX-License-Identifier: MIT
// Contrasts of pixels -> those that are cut or whose seams are opened, block by block, so that
// samples which follow each other in a list are near each other too.
#pragma once

#include "refine/pixel_contrast.h"
#include "refine/thin_parts.h"

typedef struct {
    const PixelContrasts *contrasts;
    const ThinParts *thin_parts;
    float threshold; // above which contrasts want more samples
} PixelWants;

// Cuts pixels of thin parts and those with contrasts that seams would not settle, and opens the
// seams of the others.
bool pixel_marks_take(RefineTree *tree, const PixelWants *wants, ThreadPool *pool, Error *error);
