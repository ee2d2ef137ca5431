// SPDX-License-Identifier: MIT
// Sample positions in a picture -> the color and signature of the camera ray at each position.
// Signatures differ if rays hit different surfaces or different lights reach them.
#pragma once

#include "render/renderer.h"

// A position in sub-pixels of the whole picture. The kernel skips samples whose x is NOTHING.
typedef struct {
    uint32_t x, y;
} SamplePlace;

// Requests and their results in the kernel's layout. KERNEL_SAMPLES uses SamplePlace and
// SampleData; KERNEL_LADDER uses PixelRequest and PixelSums.
typedef struct {
    const void *requests;
    void *results; // output; undefined for skipped requests
    uint32_t count;
} SampleList;

// Traces the requests in list. The renderer's kernel must be KERNEL_SAMPLES or KERNEL_LADDER.
// renderer->progress counts launches as tiles and adds to its previous counts. If the observer
// returns false, tiles_done stays below tiles and some results are missing.
bool sampler_trace(Renderer *renderer, const FrameData *frame, const SampleList *list,
                   const RenderObserver *observer, Error *error);

// Runs the kernel once on a skipped request, because some drivers finish compiling at the first
// run.
bool sampler_warm_up(Renderer *renderer, Error *error);
