// SPDX-License-Identifier: MIT
// A renderer and places of a picture -> what a camera ray sees at each.
#pragma once

#include "render/renderer.h"

// A place in sub-pixels across the whole picture; x of NOTHING leaves the sample out.
typedef struct {
    uint32_t x, y;
} SamplePlace;

// Requests as the renderer's kernel reads them, and as many results: SamplePlace and SampleData for
// KERNEL_SAMPLES, PixelRequest and PixelSums for KERNEL_LADDER.
typedef struct {
    const void *requests;
    void *results; // are left here; those of requests left out hold anything
    uint32_t count;
} SampleList;

// Answers the requests of the list by a renderer's kernel, KERNEL_SAMPLES or KERNEL_LADDER.  A tile
// of the progress is a launch here: the list's are added to those there are, and so are the
// tallies.  Where the observer stops it, fewer tiles are done than there are, and results are
// missing.
bool sampler_trace(Renderer *renderer, const FrameData *frame, const SampleList *list,
                   const RenderObserver *observer, Error *error);

// Runs the kernel once over nothing, so that drivers which finish compiling at the first run do it
// now.
bool sampler_warm_up(Renderer *renderer, Error *error);
