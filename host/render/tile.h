// SPDX-License-Identifier: MIT
// A picture's settings -> the tiles to draw, and the size of their framebuffer.
#pragma once

#include "render/render_settings.h"
#include "scene/scene.h"

// A picture is split into tiles, row by row from its upper left corner. If there are n parts, a
// part draws every n-th tile of each row, from a column that varies between rows.
typedef struct {
    uint32_t x, y, width, height; // in pixels of the crop
    uint32_t left, top;           // position in the framebuffer
} Tile;

// Stores the size of the framebuffer for the tiles. A part's framebuffer contains only the part's
// tiles, one below another.
void tile_frame_size(const RenderSettings *settings, uint32_t *width, uint32_t *height);

// Returns the number of tiles of the picture or part. Tiles are numbered from 0.
uint64_t tile_count(const RenderSettings *settings);
Tile tile_at(const RenderSettings *settings, uint64_t number);

// Returns the size of the largest tile, with x and y 0.
Tile tile_largest(const RenderSettings *settings);

// The start of the next launch: the number of a tile, and the first row to draw in this tile.
typedef struct {
    uint64_t number;
    uint32_t row;
} TileCursor;

// Returns the next launch's rectangle and advances the cursor. The cursor must not be past the last
// tile. The rectangle consists of consecutive tiles with at most `pixels` pixels together. If the
// cursor is inside a tile, or if a whole tile has more than `pixels` pixels, the rectangle consists
// of rows of one tile, at least one. The tiles of a part are not joined. *ended receives the number
// of tiles that end with this rectangle.
Tile tile_next(const RenderSettings *settings, TileCursor *cursor, uint64_t pixels,
               uint64_t *ended);

// Sets the tile that the frame draws.
void tile_aim(FrameData *frame, const RenderSettings *settings, const Tile *tile);
