// SPDX-License-Identifier: MIT
// A part of a picture takes every parts-th tile of each row of tiles. The first column differs from
// row to row, so that the tiles of each part are spread over the picture and all parts take about
// equally long.
//
// Invariants: every tile belongs to exactly one part. A pixel's bits depend on its position in the
// whole picture, and not on its tile or part. Tiles at the right and bottom edges are clipped.
#include "render/tile.h"

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

static uint64_t columns_of(const RenderSettings *settings)
{
    return parts(settings->width, settings->tile_width);
}

// Returns the column of the part's first tile in a row. Multiples of the golden ratio spread these
// columns evenly (Knuth, "The Art of Computer Programming", volume 3, section 6.4). With one column
// for all rows, a part would consist of whole columns of tiles.
static uint64_t first_column(const RenderSettings *settings, uint64_t row)
{
    const uint32_t golden = 2654435769U; // 2^32 / 1.618...
    const uint32_t stride = stride_of(settings);
    const uint64_t shift = (uint64_t)((uint32_t)row * golden) * stride >> 32;
    return (settings->part + shift) % stride;
}

static uint64_t row_count(const RenderSettings *settings, uint64_t row)
{
    const uint64_t columns = columns_of(settings), first = first_column(settings, row);
    return first < columns ? (columns - first - 1) / stride_of(settings) + 1 : 0;
}

void tile_frame_size(const RenderSettings *settings, uint32_t *width, uint32_t *height)
{
    const Tile largest = tile_largest(settings);
    const bool is_stacked = settings->parts > 0;
    *width = is_stacked ? largest.width : settings->width;
    *height = is_stacked ? (uint32_t)tile_count(settings) * largest.height : settings->height;
}

uint64_t tile_count(const RenderSettings *settings)
{
    const uint64_t rows = parts(settings->height, settings->tile_height);
    uint64_t count = 0;
    for (uint64_t row = 0; row < rows; row++)
        count += row_count(settings, row);
    return count;
}

Tile tile_at(const RenderSettings *settings, uint64_t number)
{
    const uint32_t stride = stride_of(settings);
    // If there is only one part, a division finds the row. Otherwise, the loop searches for it.
    uint64_t row = stride == 1 ? number / columns_of(settings) : 0;
    uint64_t place = stride == 1 ? number % columns_of(settings) : number;
    for (uint64_t count; place >= (count = row_count(settings, row)); row++)
        place -= count;
    const uint64_t column = first_column(settings, row) + place * stride;
    const uint32_t x = (uint32_t)column * settings->tile_width;
    const uint32_t y = (uint32_t)row * settings->tile_height;
    const bool is_stacked = settings->parts > 0;
    return (Tile){.x = x,
                  .y = y,
                  .width = smaller(settings->tile_width, settings->width - x),
                  .height = smaller(settings->tile_height, settings->height - y),
                  .left = is_stacked ? 0 : x,
                  .top = is_stacked ? (uint32_t)number * tile_largest(settings).height : y};
}

Tile tile_largest(const RenderSettings *settings)
{
    return (Tile){.width = smaller(settings->tile_width, settings->width),
                  .height = smaller(settings->tile_height, settings->height)};
}

void tile_aim(FrameData *frame, const RenderSettings *settings, const Tile *tile)
{
    frame->tile_x = settings->left + tile->x;
    frame->tile_y = settings->top + tile->y;
    frame->tile_width = tile->width;
    frame->tile_height = tile->height;
}
