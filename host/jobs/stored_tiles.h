// SPDX-License-Identifier: MIT
// Reads the settings and the tiles' pixel values from the file of a part or of a picture.
#pragma once

#include "image/exr_file.h"
#include "image/framebuffer.h"
#include "image/image_file.h"
#include "image/stored_image.h"
#include "session/picture.h"

#include <jansson.h>

typedef struct {
    RenderSettings settings; // only the sizes, `left`, `top`, `part` and `parts` are set
    Encoding encoding;
    json_t *whole; // the stored settings without the entries `part` and `tile`; owned
} StoredTiles;

// Reads the settings from the image's texts, which come from a file and are untrusted. Returns
// false if entries are missing or do not match the image's size.
bool stored_tiles_read(StoredTiles *tiles, const StoredImage *image);
void stored_tiles_free(StoredTiles *tiles);

// Appends the image's channels, except its colors, to `layers`. Returns false if the image lacks
// colors or has a channel unknown to --aov.
bool stored_tiles_name_layers(const StoredImage *image, Layers *layers);

bool stored_tiles_has_colors(const StoredImage *image);

// Returns whether the image's channels are exactly the three colors and `layers`.
bool stored_tiles_has(const StoredImage *image, const Layers *layers);

// Fills `part` for image_write. The caller frees part->tiles.
bool stored_tiles_list(const RenderSettings *settings, ImagePart *part, Error *error);

// Processes one tile. Threads call this function concurrently for different tiles.
typedef bool TileWork(const void *context, const Tile *tile, Error *error);

// Calls `work` for tiles 0 to `count` - 1 on all processors. If tiles fail, returns false and the
// error of the failed tile with the lowest number.
bool stored_tiles_run(const RenderSettings *settings, uint64_t count, TileWork *work,
                      const void *context, Error *error);

// Finds a tile in its file, as exr_file_find does. On failure, the error names the tile's position.
bool stored_tiles_find(const ExrFile *file, const Tile *tile, exr_chunk_info_t *found,
                       Error *error);

// The target of copied tiles. `framebuffer` receives the colors, and layers->values receives the
// channels in layers->list.
typedef struct {
    Framebuffer *framebuffer;
    Layers *layers;
    bool is_whole; // both have the whole picture's size, not the size from tile_frame_size
} TileTarget;

// Copies tiles 0 to `count` - 1 of the file. The file must have colors, the channels of
// target->layers, and the tile size of the settings.
bool stored_tiles_copy(const RenderSettings *settings, uint64_t count, const ExrFile *file,
                       const TileTarget *target, Error *error);
