// SPDX-License-Identifier: MIT
// A tiled OpenEXR file that clrt wrote -> its texts, and each tile, compressed or as values. Tiles
// may be missing. A file may be larger than the memory.
#pragma once

#include "base/file.h"
#include "image/provenance.h"

#include <stdio.h>

// The side of the tiles of a whole picture in pixels. The tiles of a part have the size of --tile.
#define EXR_TILE 64

#define EXR_SIDE_MAX 131072 // pixels

// The tile's position in its file, and its size there: two columns and rows of tiles, two zeros for
// the level of detail, and the number of bytes that follow.
typedef struct {
    uint32_t column, row, levels[2], size;
} ExrTileHead;

typedef struct {
    FILE *stream;     // NULL if closed
    StoredImage head; // size, channels in the file's order and texts; no values
    uint32_t tile_width, tile_height;
    File header;    // the file's bytes before the table of tiles
    uint64_t bytes; // the file's size
} ExrFile;

// Opens a tiled EXR file. Returns false if path is not one, with an error message that names path.
// The caller closes the file in both cases.
bool exr_file_open(ExrFile *file, const char *path, Error *error);
void exr_file_close(ExrFile *file);

// Finds a tile. Its head begins at *start. Returns false if the tile is missing or damaged.
bool exr_file_find(const ExrFile *file, uint32_t column, uint32_t row, uint64_t *start,
                   ExrTileHead *head);

// Reads bytes at a position. Returns false if the file ends before.
bool exr_file_read(const ExrFile *file, uint64_t start, void *bytes, size_t size);

// Returns the size in bytes of an uncompressed tile of width x height pixels.
size_t exr_tile_bytes(const ExrFile *file, uint32_t width, uint32_t height);

// Reads the values of a tile, which must have size bytes: rows of the first channel's values, then
// of the next channel's. packed must also have room for size bytes.
bool exr_file_unpack(const ExrFile *file, uint64_t start, const ExrTileHead *head,
                     unsigned char *packed, uint32_t *values, size_t size);

// Writes the header of the whole picture. `file` is one of its parts. Replaces clrt's own texts by
// those in provenance, and copies all other attributes.
bool exr_file_copy_header(const ExrFile *file, const Provenance *provenance, FILE *stream);
