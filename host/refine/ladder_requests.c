// SPDX-License-Identifier: MIT
// A pixel's samples are points of a Sobol sequence, scrambled by a hash of the pixel. If a pixel is
// divided into 2^k equal rectangles whose sides are powers of two, each rectangle holds one of the
// first 2^k points. The new samples of a higher rung therefore lie in the gaps between the earlier
// samples. The kernel adds the samples in fixed point, so sums are exact in any order.
//
// Centers are requested in blocks of PACKET_SIDE x PACKET_SIDE pixels, so neighbors share packets.
#include "refine/ladder_requests.h"

#include <math.h>
#include <stdlib.h>

#define BLOCK_PIXELS   (PACKET_SIDE * PACKET_SIDE)
#define BLOCKS_OF_TASK 256

// Coordinate x of a point is the bit-reversed index of the point. The bits of y are sums of
// binomial coefficients modulo 2. Both coordinates are linear over GF(2), so point `first + i` is
// point `first` XOR point `i`. This function computes point `first`; the kernel computes point `i`.
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

// A list of pixel blocks, which starts at block number `first` of the picture.
typedef struct {
    const PixelRequests *requests;
    Framebuffer *picture;
    uint32_t first;
} CenterBlocks;

static void list_blocks(void *context, uint32_t first, uint32_t end)
{
    const CenterBlocks *blocks = context;
    const FrameData *frame = &blocks->requests->frame;
    const uint32_t columns = range_count(frame->width, PACKET_SIDE);
    PixelRequest *request = blocks->requests->requests + (size_t)first * BLOCK_PIXELS;
    for (uint32_t block = blocks->first + first; block < blocks->first + end; block++)
        for (uint32_t i = 0; i < BLOCK_PIXELS; i++) {
            const uint32_t x = block % columns * PACKET_SIDE + i % PACKET_SIDE;
            const uint32_t y = block / columns * PACKET_SIDE + i / PACKET_SIDE;
            const bool is_inside = x < frame->width && y < frame->height;
            *request++ = (PixelRequest){.x = is_inside ? x : NOTHING, .y = y, .samples = 1};
        }
}

static void store_blocks(void *context, uint32_t first, uint32_t end)
{
    const CenterBlocks *blocks = context;
    Framebuffer *picture = blocks->picture;
    for (uint32_t i = first * BLOCK_PIXELS; i < end * BLOCK_PIXELS; i++) {
        const PixelRequest *request = &blocks->requests->requests[i];
        if (request->x != NOTHING)
            pixel_sums_mean(&blocks->requests->sums[i], 1,
                            picture->pixels[(size_t)request->y * picture->width + request->x]);
    }
}

bool pixel_requests_draw_centers(PixelRequests *requests, Framebuffer *picture, Error *error)
{
    CenterBlocks blocks = {requests, picture, 0};
    const uint32_t most = REQUESTS_MOST / BLOCK_PIXELS;
    const uint32_t all =
        range_count(picture->width, PACKET_SIDE) * range_count(picture->height, PACKET_SIDE);
    for (; blocks.first < all; blocks.first += most) {
        const uint32_t count = all - blocks.first < most ? all - blocks.first : most;
        thread_pool_share(requests->pool, count, BLOCKS_OF_TASK, list_blocks, &blocks);
        requests->count = count * BLOCK_PIXELS;
        const bool ok = pixel_requests_trace(requests, error);
        requests->count = 0;
        if (!ok || !pixel_requests_are_whole(requests))
            return ok;
        thread_pool_share(requests->pool, count, BLOCKS_OF_TASK, store_blocks, &blocks);
    }
    return true;
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
