// SPDX-License-Identifier: MIT
// The kernel adds the samples of a pixel in fixed point, so sums are exact in any order.
//
// Centers are requested in blocks of PACKET_SIDE x PACKET_SIDE pixels, so neighbors share packets.
#include "refine/ladder_requests.h"

#include <math.h>

#define BLOCK_PIXELS   (PACKET_SIDE * PACKET_SIDE)
#define BLOCKS_OF_TASK 256

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
    for (uint32_t block = blocks->first + first; block < blocks->first + end; block++) {
        const uint32_t left = block % columns * PACKET_SIDE, top = block / columns * PACKET_SIDE;
        for (uint32_t i = 0; i < BLOCK_PIXELS; i++) {
            const uint32_t x = left + i % PACKET_SIDE, y = top + i / PACKET_SIDE;
            const bool is_inside = x < frame->width && y < frame->height;
            *request++ = (PixelRequest){.x = is_inside ? x : NOTHING, .y = y, .samples = 1};
        }
    }
}

static void store_blocks(void *context, uint32_t first, uint32_t end)
{
    const CenterBlocks *blocks = context;
    Framebuffer *picture = blocks->picture;
    for (uint32_t i = first * BLOCK_PIXELS; i < end * BLOCK_PIXELS; i++) {
        const PixelRequest *request = &blocks->requests->requests[i];
        if (request->x == NOTHING)
            continue;
        float *color = picture->pixels[(size_t)request->y * picture->width + request->x];
        for (int channel = 0; channel < 3; channel++)
            color[channel] = (float)(int64_t)blocks->requests->sums[i].colors[channel] * 0x1p-32f;
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
