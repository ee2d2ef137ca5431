// SPDX-License-Identifier: MIT
// Traces lists of requests for samples of pixels, and sums the samples.
#pragma once

#include "base/array.h"
#include "base/thread_pool.h"
#include "image/framebuffer.h"
#include "render/sampler.h"
#include "scene/normalize.h"

// The largest number of requests in a list.
#define REQUESTS_MOST (1u << 16)

typedef struct {
    Renderer *renderer;             // with ladder_entry; borrowed
    FrameData frame;                // with a camera made for LADDER_GRID samples
    const RenderObserver *observer; // borrowed; may be NULL
    ThreadPool *pool;               // borrowed; NULL for none
    PixelRequest *requests;         // room for REQUESTS_MOST; small requests come first
    PixelSums *sums;                // of the requests in the latest trace; room for REQUESTS_MOST
    uint32_t count, small;          // requests in the list, and small requests in the list
} PixelRequests;

// Traces the requests and stores their sums. If the observer stops the trace, some sums are
// missing.
bool pixel_requests_trace(PixelRequests *requests, Error *error);

// Computes the mean color of the samples. `samples` must be a power of two.
void pixel_sums_mean(const PixelSums *sums, uint32_t samples, float color[3]);

// Returns the variance of the samples' colors, averaged over the channels.
double pixel_sums_variance(const PixelSums *sums, uint32_t samples);

void pixel_sums_add(PixelSums *sums, const PixelSums *more);
