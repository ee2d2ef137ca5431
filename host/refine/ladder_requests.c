// SPDX-License-Identifier: MIT
// Centers are requested in blocks of PACKET_SIDE x PACKET_SIDE pixels, which form packets.
#include "refine/ladder.h"

#include "base/array.h"
#include "render/renderer.h"

#include <math.h>
#include <stdlib.h>

#define BLOCK_PIXELS (PACKET_SIDE * PACKET_SIDE)

bool pixel_requests_make(PixelRequests *requests, Error *error)
{
    requests->requests = memory_raw(REQUESTS_MOST, sizeof *requests->requests, error);
    requests->sums = memory_raw(REQUESTS_MOST, sizeof *requests->sums, error);
    return requests->requests != NULL && requests->sums != NULL;
}

void pixel_requests_free(PixelRequests *requests)
{
    free(requests->requests);
    free(requests->sums);
    *requests = (PixelRequests){0};
}

// Coordinate x of a point is its bit-reversed index. The bits of y are sums of binomial
// coefficients modulo 2. Both are linear over GF(2), so point first + i equals point first XOR
// point i. This function computes point first; the kernel computes point i.
PixelRequest pixel_request(const uint32_t pixel[2], uint32_t first, uint32_t samples, uint64_t hash)
{
    uint32_t x = 0, y = 0, y_bits = LADDER_GRID / 2;
    for (uint32_t x_bit = LADDER_GRID / 2; x_bit != 0; x_bit /= 2, first /= 2) {
        x ^= (first & 1) * x_bit;
        y ^= (first & 1) * y_bits;
        y_bits ^= y_bits / 2;
    }
    const uint32_t scramble = (uint32_t)(hash % (LADDER_GRID * LADDER_GRID));
    return (PixelRequest){pixel[0], pixel[1], scramble ^ (x + LADDER_GRID * y), samples};
}

bool pixel_requests_are_whole(const PixelRequests *requests)
{
    const RenderProgress *progress = &requests->renderer->progress;
    return progress->tiles_done == progress->tiles;
}

bool pixel_requests_trace(PixelRequests *requests, Error *error)
{
    const SampleList list = {requests->requests, requests->sums, requests->count};
    return sampler_trace(requests->renderer, &requests->frame, &list, requests->observer, error);
}

static void store_centers(const PixelRequests *requests, Framebuffer *picture)
{
    for (uint32_t i = 0; i < requests->count; i++) {
        const PixelRequest *request = &requests->requests[i];
        if (request->x != NOTHING)
            pixel_sums_mean(&requests->sums[i], 1,
                            picture->pixels[(size_t)request->y * picture->width + request->x]);
    }
}

static void list_block(PixelRequests *requests, uint32_t left, uint32_t top)
{
    const FrameData *frame = &requests->frame;
    for (uint32_t i = 0; i < BLOCK_PIXELS; i++) {
        const uint32_t x = left + i % PACKET_SIDE, y = top + i / PACKET_SIDE;
        const bool is_inside = x < frame->width && y < frame->height;
        requests->requests[requests->count++] =
            (PixelRequest){.x = is_inside ? x : NOTHING, .y = y, .samples = 1};
    }
}

static bool trace_centers(PixelRequests *requests, Framebuffer *picture, Error *error)
{
    const bool ok = pixel_requests_trace(requests, error);
    if (ok && pixel_requests_are_whole(requests))
        store_centers(requests, picture);
    requests->count = 0;
    return ok;
}

bool pixel_requests_draw_centers(PixelRequests *requests, Framebuffer *picture, Error *error)
{
    for (uint32_t top = 0; top < picture->height; top += PACKET_SIDE)
        for (uint32_t left = 0; left < picture->width; left += PACKET_SIDE) {
            list_block(requests, left, top);
            if (requests->count + BLOCK_PIXELS > REQUESTS_MOST &&
                !trace_centers(requests, picture, error))
                return false;
            if (!pixel_requests_are_whole(requests))
                return true;
        }
    return trace_centers(requests, picture, error);
}

void pixel_sums_mean(const PixelSums *sums, uint32_t samples, float color[3])
{
    const double part = 1.0 / samples;
    for (int channel = 0; channel < 3; channel++) {
        const double mean = floor((double)(sums->colors[channel] + samples / 2) * part);
        color[channel] = (float)(mean * 0x1p-32);
    }
}

double pixel_sums_variance(const PixelSums *sums, uint32_t samples)
{
    double squares = (double)sums->squares * 0x1p-48 / samples;
    for (int channel = 0; channel < 3; channel++) {
        const double mean = (double)sums->colors[channel] * 0x1p-32 / samples;
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
