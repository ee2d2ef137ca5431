// SPDX-License-Identifier: MIT
// The kernel adds the samples of a pixel in fixed point, so sums are exact in any order.
#include "refine/ladder_requests.h"

#include <math.h>

bool pixel_requests_trace(PixelRequests *requests, Error *error)
{
    const SampleList list = {requests->requests, requests->sums, requests->count, requests->small};
    return sampler_trace(requests->renderer, &requests->frame, &list, requests->observer, error);
}

void pixel_sums_mean(const PixelSums *sums, uint32_t samples, float color[3])
{
    const double part = 1.0 / samples;
    for (int channel = 0; channel < 3; channel++) {
        const int64_t sum = (int64_t)sums->colors[channel] + samples / 2;
        color[channel] = (float)((double)(int64_t)((double)sum * part) * 0x1p-32);
    }
}

double pixel_sums_variance(const PixelSums *sums, uint32_t samples)
{
    const double part = 1.0 / samples;
    double squares = (double)(int64_t)sums->squares * (0x1p-48 * part);
    for (int channel = 0; channel < 3; channel++) {
        const double mean = (double)(int64_t)sums->colors[channel] * (0x1p-32 * part);
        squares -= mean * mean;
    }
    return fmax(squares / 3, 0);
}

void pixel_sums_add(PixelSums *sums, const PixelSums *more)
{
    for (int channel = 0; channel < 3; channel++)
        sums->colors[channel] += more->colors[channel];
    sums->squares += more->squares;
}
