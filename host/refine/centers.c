// SPDX-License-Identifier: MIT
// Blocks of pixels are consecutive in the list of samples, because rays of nearby pixels traverse
// the tree together.
#include "refine/centers.h"

#include "base/thread_pool.h"
#include "refine/probe.h"

#include <stdlib.h>

static uint32_t block_columns(const Centers *centers)
{
    return range_count(centers->width, PACKET_SIDE);
}

static uint32_t index_of(const Centers *centers, uint32_t x, uint32_t y)
{
    const uint32_t block = y / PACKET_SIDE * block_columns(centers) + x / PACKET_SIDE;
    return block * (PACKET_SIDE * PACKET_SIDE) + y % PACKET_SIDE * PACKET_SIDE + x % PACKET_SIDE;
}

// Lists the centers of all blocks. Blocks may extend beyond the picture.
static void list_places(const Centers *centers, SamplePlace *places)
{
    for (uint32_t top = 0; top < centers->height; top += PACKET_SIDE)
        for (uint32_t left = 0; left < centers->width; left += PACKET_SIDE)
            for (uint32_t i = 0; i < PACKET_SIDE * PACKET_SIDE; i++) {
                const uint32_t x = left + i % PACKET_SIDE, y = top + i / PACKET_SIDE;
                const bool is_there = x < centers->width && y < centers->height;
                *places++ = (SamplePlace){is_there ? REFINE_GRID * x + REFINE_GRID / 2 : NOTHING,
                                          REFINE_GRID * y + REFINE_GRID / 2};
            }
}

bool centers_trace(Centers *centers, Renderer *renderer, const FrameData *frame,
                   const RenderObserver *observer, Error *error)
{
    *centers = (Centers){.width = frame->width, .height = frame->height};
    const uint32_t count = block_columns(centers) * range_count(frame->height, PACKET_SIDE) *
                           PACKET_SIDE * PACKET_SIDE;
    SamplePlace *places = memory_raw(count, sizeof *places, error);
    centers->samples = memory_zeroed(count, sizeof *centers->samples, error);
    const SampleList list = {places, centers->samples, count, 0};
    const bool ok = places != NULL && centers->samples != NULL;
    if (ok)
        list_places(centers, places);
    const bool traced = ok && sampler_trace(renderer, frame, &list, observer, error);
    free(places);
    return traced;
}

void centers_free(Centers *centers)
{
    free(centers->samples);
    *centers = (Centers){0};
}

const SampleData *centers_at(const Centers *centers, uint32_t pixel)
{
    return &centers->samples[index_of(centers, pixel % centers->width, pixel / centers->width)];
}

bool centers_have_neighbor(const Centers *centers, uint32_t pixel, Side side, uint32_t *neighbor)
{
    const uint32_t x = pixel % centers->width, y = pixel / centers->width;
    switch (side) {
    case SIDE_LEFT:
        *neighbor = pixel - 1;
        return x > 0;
    case SIDE_RIGHT:
        *neighbor = pixel + 1;
        return x + 1 < centers->width;
    case SIDE_ABOVE:
        *neighbor = pixel - centers->width;
        return y > 0;
    default:
        *neighbor = pixel + centers->width;
        return y + 1 < centers->height;
    }
}

const SampleData *centers_beside(const Centers *centers, uint32_t pixel, Side side)
{
    uint32_t neighbor;
    return centers_at(centers,
                      centers_have_neighbor(centers, pixel, side, &neighbor) ? neighbor : pixel);
}
