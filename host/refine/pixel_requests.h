// SPDX-License-Identifier: MIT
// Traces requests for samples of pixels, in lists of bounded size, and returns the sums of the
// samples.
#pragma once

#include "render/renderer.h"

// The most requests per list.
#define REQUESTS_MOST (1u << 18)

typedef struct {
    Renderer *renderer;             // of KERNEL_LADDER; borrowed
    FrameData frame;                // with a camera made for LADDER_GRID samples
    const RenderObserver *observer; // borrowed; may be NULL
    PixelRequest *requests;         // REQUESTS_MOST entries, of which count are in use; all
                                    // have the same number of samples
    PixelSums *sums;                // of the requests traced last
    uint32_t count;
} PixelRequests;

bool pixel_requests_make(PixelRequests *requests, Error *error);
void pixel_requests_free(PixelRequests *requests);

// Returns a request for samples first to first + samples - 1 of a pixel. samples is 4 or
// REQUEST_SAMPLES, and first is a multiple of samples. The positions are points of the
// two-dimensional Sobol sequence, XORed with the low bits of hash (Sobol, "On the distribution of
// points in a cube and the approximate evaluation of integrals", 1967).
PixelRequest pixel_request(const uint32_t pixel[2], uint32_t first, uint32_t samples,
                           uint64_t hash);

// Returns whether the last trace completed without a stop by the observer.
bool pixel_requests_are_whole(const PixelRequests *requests);

// Traces the requests and stores their sums. If the observer stops it, some sums are missing.
bool pixel_requests_trace(PixelRequests *requests, Error *error);

// Renders a picture of the frame's size with one sample at each pixel's center.
bool pixel_requests_draw_centers(PixelRequests *requests, Framebuffer *picture, Error *error);

// Computes the mean color of that many samples.
void pixel_sums_mean(const PixelSums *sums, uint32_t samples, float color[3]);

// Returns the variance of that many samples, averaged over the channels.
double pixel_sums_variance(const PixelSums *sums, uint32_t samples);

void pixel_sums_add(PixelSums *sums, const PixelSums *more);
