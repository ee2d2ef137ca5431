// SPDX-License-Identifier: MIT
// Sample positions in a picture -> colors and signatures, or sums of colors (ladder_entry).
// Signatures differ if rays hit different surfaces, or if different lights reach the hit points.
#pragma once

#include "render/renderer.h"

// The kernels trace_samples and trace_pixels.
extern const KernelEntry sample_entry, ladder_entry;

// A position in sub-pixels of the whole picture. The kernel skips samples whose x is NOTHING.
typedef struct {
    uint32_t x, y;
} SamplePlace;

// Requests and their results in the kernel's layout. sample_entry uses SamplePlace and
// SampleData; ladder_entry uses PixelRequest and PixelSums.
typedef struct {
    const void *requests;
    void *results; // output; undefined for skipped requests
    uint32_t count;
} SampleList;

// Traces the requests in list. The renderer's kernel must have sample_entry or ladder_entry.
// renderer->progress counts launches as tiles and adds to its previous counts. If the observer
// stops the trace, tiles_done stays below tiles and some results are missing.
bool sampler_trace(Renderer *renderer, const FrameData *frame, const SampleList *list,
                   const RenderObserver *observer, Error *error);
