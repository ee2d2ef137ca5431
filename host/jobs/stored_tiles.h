// SPDX-License-Identifier: MIT
// A picture file with some tiles finished -> their numbers and their values.
#pragma once

#include "image/framebuffer.h"
#include "image/image_file.h"
#include "image/stored_image.h"
#include "render/renderer.h"

#include <jansson.h>

typedef struct {
    RenderSettings settings; // sizes, tiles and part
    Encoding encoding;
    json_t *whole; // the settings of the whole picture; owned
} StoredTiles;

// Reads the tile entries from the image's texts, which come from a file and are untrusted.  Returns
// false if they are missing or do not fit the image.
bool stored_tiles_read(StoredTiles *tiles, const StoredImage *image);
void stored_tiles_free(StoredTiles *tiles);

// Returns whether the settings match the image's, apart from the finished tiles.  Stores their
// number in *tiles.
bool stored_tiles_done(const StoredImage *image, const char *settings_text,
                       const RenderSettings *settings, uint64_t *tiles);

// Names the image's channels beside its colors.  Returns false if the image lacks colors or has a
// channel unknown to --aov.
bool stored_tiles_name_layers(const StoredImage *image, Layers *layers);

bool stored_tiles_has_colors(const StoredImage *image);

// Returns whether the image has exactly three colors and those layers.
bool stored_tiles_has(const StoredImage *image, const Layers *layers);

// Copies the first count tiles: the colors into framebuffer, and the channels named by layers into
// layers.  The image must have all of them.
void stored_tiles_copy(const RenderSettings *settings, uint64_t count, const StoredImage *image,
                       Framebuffer *framebuffer, Layers *layers);
