// SPDX-License-Identifier: MIT
// Adaptive anti-aliasing: a sample a pixel, and then more where neighbors differ.  What is decided
// depends on the whole picture and on no order, so that every device draws the same.
#pragma once

#include "base/parallel.h"
#include "refine/footprint.h"
#include "refine/pixel_contrast.h"
#include "refine/thin_parts.h"
#include "render/renderer.h"

// Samples that cutting a cell takes.
#define ADAPTIVE_CUT (GROUP_CELLS - 1)

// Of a threshold, where seams are placed: a sample halves one, where cutting a cell takes eight.
#define ADAPTIVE_SEAM_PART 0.15f

typedef struct {
    Renderer *renderer; // of KERNEL_SAMPLES; borrowed
    Crew *crew;         // borrowed
    FrameData frame;
    RefineTree tree;
    PixelContrasts pixel_contrasts;
    Footprints footprints; // of small spheres, whose cells are cut in any case
    ThinParts thin_parts;  // of meshes, the same
    uint64_t samples;      // taken
} Adaptive;

// What it stands on.
typedef struct {
    Renderer *renderer;       // of KERNEL_SAMPLES
    const FlatScene *flat;    // of the renderer
    const CameraData *camera; // made for REFINE_GRID samples
    Crew *crew;               // to share the work, NULL for none
    const Scene *scene;       // of the renderer too
    const Normalization *normalization;
} AdaptiveSetup;

// Takes one sample a pixel.
bool adaptive_open(Adaptive *adaptive, const AdaptiveSetup *setup, const RenderObserver *observer,
                   Error *error);

// Refines until no cell has a contrast above the threshold, in parts of one and of a pixel's area,
// or the observer stops it.
bool adaptive_refine(Adaptive *adaptive, float threshold, const RenderObserver *observer,
                     Error *error);

// Whether the observer has not stopped it.
bool adaptive_is_whole(const Adaptive *adaptive);

// Stores the picture, as far as it is refined.
void adaptive_store(const Adaptive *adaptive, Framebuffer *framebuffer);

void adaptive_close(Adaptive *adaptive);
