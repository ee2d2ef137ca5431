// SPDX-License-Identifier: MIT
// Splits a picture into tiles, row by row from its upper left corner, and selects the tiles to
// draw. A part draws every parts-th tile of each row, and starts in another column in each row.
#pragma once

#include "render/renderer.h"

typedef struct {
    uint32_t x, y, width, height; // in pixels of the crop
    uint32_t left, top;           // position in the framebuffer
} Tile;

// Stores the size of the framebuffer in which the tiles are drawn. A part's framebuffer contains
// only the part's tiles, below each other.
void tile_frame_size(const RenderSettings *settings, uint32_t *width, uint32_t *height);

// Return the number of tiles to draw, and the position and size of one of them.
uint64_t tile_count(const RenderSettings *settings);
Tile tile_at(const RenderSettings *settings, uint64_t number);

// Returns the size of the largest tile, with x and y 0.
Tile tile_largest(const RenderSettings *settings);

// Returns the number of pixels in all tiles to draw.
uint64_t tile_pixels(const RenderSettings *settings);

// Sets the tile that the frame draws.
void tile_aim(FrameData *frame, const RenderSettings *settings, const Tile *tile);

// Stores in grid the number of work-items along both sides of a tile, rounded up to whole
// work-groups. All tiles have the same grid, including clipped tiles.
void tile_grid(const RenderSettings *settings, NodeLayout nodes, size_t grid[2]);
