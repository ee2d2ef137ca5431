// SPDX-License-Identifier: MIT
// Adaptive anti-aliasing takes one sample per pixel, and then more where neighbors differ or parts
// are thin. The idea is from Whitted, "An improved illumination model for shaded display", 1980.
//
// Each pixel is the root of a tree of cells (refine_tree.h). A cell is subdivided if its color
// differs too much from a neighbor's (contrast.h). It is also subdivided if it touches a triangle
// or sphere that samples may miss (thin_parts.h). Inside subdivided pixels, bisection locates edges
// with fewer samples than further subdivision (seam.h).
//
// A pass selects all its cells before it traces any of them, so that the samples form one large
// list for the device.
//
// Invariant: the selection depends only on finished samples and not on the order of work. The bits
// of the picture therefore do not depend on the device or on the number of threads.
#pragma once

#include "base/thread_pool.h"
#include "image/framebuffer.h"
#include "refine/thin_parts.h"
#include "render/sampler.h"

typedef struct {
    Renderer *renderer; // with sample_entry; borrowed
    ThreadPool *pool;   // borrowed
    FrameData frame;
    RefineTree tree;
    ThinParts thin_parts; // cells that are always subdivided
    uint64_t samples;     // taken so far
} Adaptive;

// The inputs of adaptive anti-aliasing.
typedef struct {
    Renderer *renderer;       // with sample_entry
    const FlatScene *flat;    // the renderer's scene
    const CameraData *camera; // made for REFINE_GRID samples
    ThreadPool *pool;         // threads for the work, NULL for none
    const Scene *scene;       // the source of flat
    const Normalization *normalization;
} AdaptiveSetup;

// Makes a picture with one sample per pixel.
bool adaptive_open(Adaptive *adaptive, const AdaptiveSetup *setup, const RenderObserver *observer,
                   Error *error);

// Subdivides cells whose contrast exceeds the threshold, and cells with thin parts, down to the
// last level. Stops when the observer returns false. The caller may call this function only once.
bool adaptive_refine(Adaptive *adaptive, float threshold, const RenderObserver *observer,
                     Error *error);

// Stores the picture in its current state.
void adaptive_store(const Adaptive *adaptive, Framebuffer *framebuffer);

void adaptive_close(Adaptive *adaptive);
