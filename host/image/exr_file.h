// SPDX-License-Identifier: MIT
// Reads tiled OpenEXR files that clrt wrote: their texts, and each tile as compressed bytes or as
// values. Tiles may be missing, and a file may be larger than the memory. Threads may share an open
// file.
#pragma once

#include "image/framebuffer.h"
#include "image/stored_image.h"

#include <openexr.h>
#include <stdio.h>

// The side, in pixels, of a whole picture's tiles. A part has its own tile size (--tune tile).
#define EXR_TILE 64

typedef struct {
    exr_context_t context; // NULL if closed; points to this struct, so the struct must not move
    FILE *stream;          // NULL if closed
    uint64_t most;         // reads may begin up to this offset
    StoredImage head;      // size, texts, and channels in the file's order; no values
    uint32_t tile_width, tile_height, tile_count;
} ExrFile;

// Opens a tiled EXR file. On failure, returns false with a message that names `path`. The caller
// closes the file in both cases.
bool exr_file_open(ExrFile *file, const char *path, Error *error);
void exr_file_close(ExrFile *file);

// Finds a tile by its column and row. Returns false if the tile is missing or damaged, extends past
// the end of the file, or has fewer bytes than its pixels need even at the highest compression.
bool exr_file_find(const ExrFile *file, uint32_t column, uint32_t row, exr_chunk_info_t *tile);

// Reads tile->packed_size bytes and verifies the checksum. A tile stored without compression has no
// checksum. `scratch` has room for tile->unpacked_size bytes. Returns false if the tile cannot be
// read or is damaged.
bool exr_file_read(const ExrFile *file, const exr_chunk_info_t *tile, unsigned char *bytes,
                   unsigned char *scratch);

// Copies the values of a tile into `framebuffer` and `layers`. `position` is the X and Y, in the
// framebuffer, of the tile's upper left pixel. Skips the tile's other channels. Returns false on
// failure.
bool exr_file_decode(const ExrFile *file, const exr_chunk_info_t *tile,
                     const Framebuffer *framebuffer, const Layers *layers,
                     const size_t position[2]);

// Points each of a tile's channels to its values in `framebuffer` or `layers`. `layers` may be
// NULL. `position` is the X and Y, in the framebuffer, of the tile's upper left pixel. The tile's
// other channels keep their pointers.
void exr_place_channels(exr_coding_channel_info_t *channels, int count,
                        const Framebuffer *framebuffer, const Layers *layers,
                        const size_t position[2]);

// The bytes before a compressed tile: column, row, two zeros for the level of detail, and size.
typedef struct {
    uint32_t column, row, levels[2], size;
} ExrTileHead;

ExrTileHead exr_tile_head(const exr_chunk_info_t *tile, uint64_t size);

// An error handler that does nothing, because OpenEXRCore's functions also return their failures.
void exr_file_ignore(exr_const_context_t context, exr_result_t code, const char *message);
