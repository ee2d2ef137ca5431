// SPDX-License-Identifier: MIT
// Decides by contrast which pixels are subdivided and which only get seams. Pixels are visited
// block by block, so that consecutive samples are near each other.
#pragma once

#include "refine/pixel_contrast.h"
#include "refine/thin_parts.h"

typedef struct {
    const PixelContrasts *contrasts;
    const ThinParts *thin_parts;
    float threshold; // pixels with more contrast need samples
} PixelWants;

// Subdivides pixels with thin parts and pixels whose contrast exceeds the threshold even with
// seams. Opens the seams of the other pixels above the threshold.
bool pixel_marks_take(RefineTree *tree, const PixelWants *wants, Crew *crew, Error *error);
