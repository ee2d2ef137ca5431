// SPDX-License-Identifier: MIT
// Adaptive anti-aliasing: one sample per pixel, then more where neighbors differ. Decisions depend
// on the whole picture and not on the order of work, so every device renders the same bits.
#pragma once

#include "base/thread_pool.h"
#include "refine/pixel_contrast.h"
#include "refine/refine_tree.h"
#include "refine/thin_parts.h"
#include "render/renderer.h"

// The number of new samples of a subdivided cell.
#define ADAPTIVE_CUT (GROUP_CELLS - 1)

// Bisection of a seam stops at this fraction of the threshold. The fraction is small because
// halving an interval takes one sample, but subdividing a cell takes eight.
#define ADAPTIVE_SEAM_PART 0.15f

typedef struct {
    Renderer *renderer; // of KERNEL_SAMPLES; borrowed
    ThreadPool *pool;   // borrowed
    FrameData frame;
    RefineTree tree;
    PixelContrasts pixel_contrasts;
    Footprints footprints; // small spheres; their cells are always subdivided
    ThinParts thin_parts;  // thin parts of meshes; their cells are always subdivided
    uint64_t samples;      // the number of samples taken
} Adaptive;

// The inputs of adaptive anti-aliasing.
typedef struct {
    Renderer *renderer;       // of KERNEL_SAMPLES
    const FlatScene *flat;    // of the renderer
    const CameraData *camera; // made for REFINE_GRID samples
    ThreadPool *pool;         // threads for the work, NULL for none
    const Scene *scene;       // of the renderer
    const Normalization *normalization;
} AdaptiveSetup;

// Takes one sample per pixel.
bool adaptive_open(Adaptive *adaptive, const AdaptiveSetup *setup, const RenderObserver *observer,
                   Error *error);

// Refines until no cell's contrast exceeds the threshold, or until the observer stops it. The
// contrast is a color difference in [0, 1] times the cell's fraction of a pixel.
bool adaptive_refine(Adaptive *adaptive, float threshold, const RenderObserver *observer,
                     Error *error);

// Stores the picture in its current state.
void adaptive_store(const Adaptive *adaptive, Framebuffer *framebuffer);

void adaptive_close(Adaptive *adaptive);

// Decides by contrast which pixels are subdivided and which only get seams. Pixels are visited
// block by block, so that consecutive samples are near each other.
typedef struct {
    const PixelContrasts *contrasts;
    const ThinParts *thin_parts;
    float threshold; // pixels with more contrast need samples
} PixelWants;

// Subdivides pixels with thin parts and pixels whose contrast exceeds the threshold even with
// seams. Opens the seams of the other pixels above the threshold.
bool pixel_marks_take(RefineTree *tree, const PixelWants *wants, ThreadPool *pool, Error *error);
