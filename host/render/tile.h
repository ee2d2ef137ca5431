// SPDX-License-Identifier: MIT
// How a picture is cut into tiles, row after row from its upper left corner, and
// which of the tiles are drawn.
#pragma once

#include "render/renderer.h"

typedef struct {
    uint32_t x, y, width, height; // in pixels of what is drawn
} Tile;

// Those that are drawn.
uint64_t tile_count(const RenderSettings *settings);
Tile tile_at(const RenderSettings *settings, uint64_t number);

// As large as any.
Tile tile_largest(const RenderSettings *settings);

// Of all tiles that are drawn.
uint64_t tile_pixels(const RenderSettings *settings);

// Has the kernels draw that tile.
void tile_aim(FrameData *frame, const RenderSettings *settings, const Tile *tile);

// Work-items along the sides of a tile, padded to whole work-groups: the same for all tiles, those
// that the picture's edge cuts off among them.
void tile_grid(const RenderSettings *settings, NodeLayout nodes, size_t grid[2]);
