// SPDX-License-Identifier: MIT
// A tiled OpenEXR file that clrt wrote -> its texts, and each tile, compressed or as values. Tiles
// may be missing. A file may be larger than the memory. Threads may share an open file.
#pragma once

#include "image/stored_image.h"

#include <openexr.h>

// The side of the tiles of a whole picture in pixels. The tiles of a part have the size of --tile.
#define EXR_TILE 64

#define EXR_SIDE_MAX 131072 // pixels

typedef struct {
    exr_context_t context; // NULL if closed
    StoredImage head;      // size, channels in the file's order and texts; no values
    uint32_t tile_width, tile_height;
} ExrFile;

// Opens a tiled EXR file. Returns false if path is not one, with an error message that names path.
// The caller closes the file in both cases.
bool exr_file_open(ExrFile *file, const char *path, Error *error);
void exr_file_close(ExrFile *file);

// Finds a tile by its column and row. Returns false if the tile is missing or damaged, or extends
// past the end of the file.
bool exr_file_find(const ExrFile *file, uint32_t column, uint32_t row, exr_chunk_info_t *tile);

// Reads tile->packed_size compressed bytes and checks them. scratch needs tile->unpacked_size
// bytes. Returns false if the tile is damaged. Tiles stored without compression have no checksum.
bool exr_file_read(const ExrFile *file, const exr_chunk_info_t *tile, unsigned char *bytes,
                   unsigned char *scratch);

// The memory for one channel of a tile.
typedef struct {
    void *start;                  // of the tile's first pixel; NULL skips the channel
    size_t pixel_size, line_size; // bytes from a pixel to the next one, and to the one below
} ExrTarget;

// Stores the values of a tile, of 32 bits each. targets has head.channel_count entries. Returns
// false if the tile is damaged.
bool exr_file_decode(const ExrFile *file, const exr_chunk_info_t *tile, const ExrTarget *targets);
