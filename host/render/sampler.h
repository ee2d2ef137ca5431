// SPDX-License-Identifier: MIT
// A list of requests -> their samples. With sample_entry, a request is a sample's position, and the
// result is its color. With ladder_entry, a request is a small or large set of a pixel's samples
// (SMALL_SAMPLES, LARGE_SAMPLES). The result has the sums of these samples' colors and of the
// colors' squares. Both also render pictures with one sample per pixel.
#pragma once

#include "render/renderer.h"

// The kernel trace_samples, with and without CLRT_PLACES.
extern const KernelEntry sample_entry, ladder_entry;

// Requests and their results in the kernel's layout. sample_entry uses SamplePlace and
// SampleData; ladder_entry uses PixelRequest and PixelSums.
typedef struct {
    const void *requests;
    void *results; // output
    uint32_t count;
    uint32_t small; // with ladder_entry: number of small requests, which precede the large ones
} SampleList;

// Traces the requests in `list`. The frame's tile members must be 0, except when
// sampler_draw_centers calls this function. The renderer's kernel must have sample_entry or
// ladder_entry. renderer->progress counts every 4096 work-items as a tile, and adds them to its
// previous counts. If the observer stops the trace early, tiles_done stays below tiles, and some
// results are undefined.
bool sampler_trace(Renderer *renderer, const FrameData *frame, const SampleList *list,
                   const RenderObserver *observer, Error *error);

// Renders the whole picture, with one sample at the center of each pixel. The frame's tile members
// must be 0. The frame's camera must be made for frame->samples samples. Stores the pixels row by
// row. Stops as sampler_trace does.
bool sampler_draw_centers(Renderer *renderer, const FrameData *frame, float (*pixels)[3],
                          const RenderObserver *observer, Error *error);

// Returns whether the observer has stopped none of the renderer's traces.
bool sampler_is_whole(const Renderer *renderer);
