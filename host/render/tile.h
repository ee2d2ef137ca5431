// SPDX-License-Identifier: MIT
// Splits a picture into tiles, row by row from its upper left corner, and selects the tiles to
// draw.
#pragma once

#include "render/renderer.h"

typedef struct {
    uint32_t x, y, width, height; // in pixels of the crop
} Tile;

// Number and position of the tiles to draw.
uint64_t tile_count(const RenderSettings *settings);
Tile tile_at(const RenderSettings *settings, uint64_t number);

// Returns a tile of the largest size.
Tile tile_largest(const RenderSettings *settings);

// Returns the number of pixels in all tiles to draw.
uint64_t tile_pixels(const RenderSettings *settings);

// Sets the frame to draw that tile.
void tile_aim(FrameData *frame, const RenderSettings *settings, const Tile *tile);

// Returns in grid the work-items along both sides of a tile, padded to whole work-groups.  All
// tiles, clipped ones included, have the same grid.
void tile_grid(const RenderSettings *settings, NodeLayout nodes, size_t grid[2]);
