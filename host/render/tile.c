// SPDX-License-Identifier: MIT
// Tiles at the right and bottom edges are clipped.
#include "render/renderer.h"

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static uint64_t parts(uint32_t whole, uint32_t part)
{
    return ((uint64_t)whole + part - 1) / part;
}

static uint32_t stride_of(const RenderSettings *settings)
{
    return settings->parts > 0 ? settings->parts : 1;
}

uint64_t tile_count(const RenderSettings *settings)
{
    const uint64_t all = parts(settings->width, settings->tile_width) *
                         parts(settings->height, settings->tile_height);
    const uint32_t stride = stride_of(settings);
    return (all + stride - 1 - settings->part) / stride;
}

Tile tile_at(const RenderSettings *settings, uint64_t number)
{
    const uint64_t place = number * stride_of(settings) + settings->part;
    const uint64_t columns = parts(settings->width, settings->tile_width);
    const uint32_t x = (uint32_t)(place % columns) * settings->tile_width;
    const uint32_t y = (uint32_t)(place / columns) * settings->tile_height;
    return (Tile){x, y, smaller(settings->tile_width, settings->width - x),
                  smaller(settings->tile_height, settings->height - y)};
}

Tile tile_largest(const RenderSettings *settings)
{
    return (Tile){.width = smaller(settings->tile_width, settings->width),
                  .height = smaller(settings->tile_height, settings->height)};
}

uint64_t tile_pixels(const RenderSettings *settings)
{
    uint64_t pixels = 0;
    const uint64_t count = tile_count(settings);
    for (uint64_t number = 0; number < count; number++) {
        const Tile tile = tile_at(settings, number);
        pixels += (uint64_t)tile.width * tile.height;
    }
    return pixels;
}

void tile_aim(FrameData *frame, const RenderSettings *settings, const Tile *tile)
{
    frame->tile_x = settings->left + tile->x;
    frame->tile_y = settings->top + tile->y;
    frame->tile_width = tile->width;
    frame->tile_height = tile->height;
}

static size_t grid_side(NodeLayout nodes, uint32_t tile_side, uint32_t group)
{
    const uint32_t pixels = nodes == NODES_WIDE ? BLOCK_SIDE : 1;
    const size_t items = ((size_t)tile_side + pixels - 1) / pixels;
    return (items + group - 1) / group * group;
}

void tile_grid(const RenderSettings *settings, NodeLayout nodes, size_t grid[2])
{
    const Tile largest = tile_largest(settings);
    grid[0] = grid_side(nodes, largest.width, settings->group_width);
    grid[1] = grid_side(nodes, largest.height, settings->group_height);
}
