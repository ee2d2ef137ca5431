// SPDX-License-Identifier: MIT
// Requests for samples of pixels -> their sums, traced in lists of bounded size.
#pragma once

#include "render/renderer.h"

// Requests that are traced at once.
#define REQUESTS_MOST (1u << 18)

typedef struct {
    Renderer *renderer;             // of KERNEL_LADDER; borrowed
    FrameData frame;                // with a camera made for LADDER_GRID samples
    const RenderObserver *observer; // borrowed; may be NULL
    PixelRequest *requests;         // REQUESTS_MOST of them, of which count are there; all have
                                    // as many samples
    PixelSums *sums;                // of the requests that were traced last
    uint32_t count;
} PixelRequests;

bool pixel_requests_make(PixelRequests *requests, Error *error);
void pixel_requests_free(PixelRequests *requests);

// Samples first to first + samples - 1 of a pixel, samples being 4 or REQUEST_SAMPLES and first a
// multiple of it.  Their places are points of Sobol's sequence in two dimensions ("On the
// distribution of points in a cube and the approximate evaluation of integrals", 1967), scrambled
// by XOR with the low bits of a hash.
PixelRequest pixel_request(const uint32_t pixel[2], uint32_t first, uint32_t samples,
                           uint64_t hash);

// Whether the observer has not stopped what was traced.
bool pixel_requests_are_whole(const PixelRequests *requests);

// Traces the requests and leaves their sums, some of which are missing where it was stopped.
bool pixel_requests_trace(PixelRequests *requests, Error *error);

// Draws a picture of the frame's size from the centers of its pixels.
bool pixel_requests_draw_centers(PixelRequests *requests, Framebuffer *picture, Error *error);

// The mean color of that many samples.
void pixel_sums_mean(const PixelSums *sums, uint32_t samples, float color[3]);

// The variance of that many samples, averaged over the channels.
double pixel_sums_variance(const PixelSums *sums, uint32_t samples);

void pixel_sums_add(PixelSums *sums, const PixelSums *more);
