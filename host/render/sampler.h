// SPDX-License-Identifier: MIT
// A renderer and sample positions in a picture -> the color and signature of a camera ray at each.
#pragma once

#include "render/renderer.h"

// A position in sub-pixels of the whole picture; an x of NOTHING skips the sample.
typedef struct {
    uint32_t x, y;
} SamplePlace;

// Requests in the kernel's layout, and as many results.  KERNEL_SAMPLES uses SamplePlace and
// SampleData; KERNEL_LADDER uses PixelRequest and PixelSums.
typedef struct {
    const void *requests;
    void *results; // output; undefined for skipped requests
    uint32_t count;
} SampleList;

// Traces the requests of the list.  The renderer's kernel must be KERNEL_SAMPLES or KERNEL_LADDER.
// A launch counts as a tile of the progress; its tiles and tallies are added to the existing
// counts.  If the observer stops it, tiles_done stays below tiles and results are missing.
bool sampler_trace(Renderer *renderer, const FrameData *frame, const SampleList *list,
                   const RenderObserver *observer, Error *error);

// Runs the kernel once over nothing, because some drivers finish compiling at the first run.
bool sampler_warm_up(Renderer *renderer, Error *error);
