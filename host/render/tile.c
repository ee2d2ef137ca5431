// SPDX-License-Identifier: MIT
// If there are n parts, each part has every n-th tile of a row. The first of these tiles is in
// another column in each row. A part's tiles are therefore spread over the picture, and all parts
// take about equally long.
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
    // If there is only one part, a division finds the row. Otherwise, the loop searches for the
    // row.
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

// Returns the number of tiles, at most `most`, that form a rectangle from tile `first` on. The
// rectangle consists of tiles of one row, or of whole rows.
static uint64_t joined_count(const RenderSettings *settings, uint64_t first, uint64_t most)
{
    const uint64_t columns = columns_of(settings), left = columns - first % columns;
    if (settings->parts > 0)
        return 1;
    if (left < columns || most < columns)
        return most < left ? most : left;
    const uint64_t rest = tile_count(settings) - first;
    return most < rest ? most / columns * columns : rest;
}

static Tile join_tiles(const RenderSettings *settings, uint64_t first, uint64_t count)
{
    Tile joined = tile_at(settings, first);
    const Tile last = tile_at(settings, first + count - 1);
    joined.width = last.x + last.width - joined.x;
    joined.height = last.y + last.height - joined.y;
    return joined;
}

Tile tile_next(const RenderSettings *settings, TileCursor *cursor, uint64_t pixels, uint64_t *ended)
{
    const Tile largest = tile_largest(settings);
    const uint64_t tiles = pixels / ((uint64_t)largest.width * largest.height);
    if (cursor->row == 0 && tiles > 0) {
        *ended = joined_count(settings, cursor->number, tiles);
        cursor->number += *ended;
        return join_tiles(settings, cursor->number - *ended, *ended);
    }
    Tile rows = tile_at(settings, cursor->number);
    const uint64_t fitting = pixels > rows.width ? pixels / rows.width : 1;
    const uint32_t left = rows.height - cursor->row;
    rows.y += cursor->row;
    rows.top += cursor->row;
    rows.height = fitting < left ? (uint32_t)fitting : left;
    *ended = rows.height == left;
    *cursor = (TileCursor){cursor->number + *ended, *ended ? 0 : cursor->row + rows.height};
    return rows;
}

void tile_aim(FrameData *frame, const RenderSettings *settings, const Tile *tile)
{
    frame->tile_x = settings->left + tile->x;
    frame->tile_y = settings->top + tile->y;
    frame->tile_width = tile->width;
    frame->tile_height = tile->height;
}
