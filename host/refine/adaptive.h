// SPDX-License-Identifier: MIT
// Adaptive anti-aliasing takes one sample per pixel, and then more samples where neighbors differ
// or parts are thin. The idea is from Whitted, "An improved illumination model for shaded display",
// 1980.
//
// A pixel is refined if its color differs too much from the color of a neighbor, or if the pixel
// touches a triangle or sphere that samples may miss (thin_parts.h). Refined pixels have samples on
// scan lines (scan_lines.h). If samples near the border of a refined pixel differ from the neighbor
// there, the neighbor is refined too.
//
// A pass selects all its places before it traces any of them, so that the samples form one large
// list for the device.
//
// Invariant: the selection depends only on finished samples and not on the order of work. The bits
// of the picture therefore do not depend on the device or on the number of threads.
#pragma once

#include "refine/refine_setup.h"
#include "refine/scan_lines.h"
#include "refine/thin_parts.h"
#include "render/sampler.h"

typedef struct {
    RefineSetup setup;
    FrameData frame;
    const SampleData *centers; // of the pixels: the picture, until the last step
    uint32_t *refined;         // by pixel: index in lines.pixels; 0 if the pixel has one sample
    ThinParts thin_parts;
    ScanLines lines;
    float most;       // largest color difference between pixels that are not refined
    uint64_t samples; // taken so far
} Adaptive;

// Takes one sample per pixel. Fails if the picture has more than 2^31 pixels.
bool adaptive_open(Adaptive *adaptive, const RefineSetup *setup, Error *error);

// Refines pixels whose contrast exceeds `threshold`, and pixels with thin parts. Stops when the
// observer returns false. Then stores the colors of all pixels in the setup's picture. The caller
// may call this function only once.
bool adaptive_refine(Adaptive *adaptive, float threshold, Error *error);

// Returns the number of samples taken in a pixel.
uint32_t adaptive_pixel_samples(const Adaptive *adaptive, size_t pixel);

void adaptive_close(Adaptive *adaptive);
