// SPDX-License-Identifier: MIT
// A partly finished picture file -> its settings, and the number and pixel values of its finished
// tiles.
#pragma once

#include "image/framebuffer.h"
#include "image/image_file.h"
#include "image/stored_image.h"
#include "render/renderer.h"

#include <jansson.h>

typedef struct {
    RenderSettings settings; // only sizes, tile size and part are set
    Encoding encoding;
    json_t *whole; // the settings text without `part` and `tile`; owned
} StoredTiles;

// Reads the settings from the image's texts, which come from a file and are untrusted. Returns
// false if entries are missing or do not match the image's size.
bool stored_tiles_read(StoredTiles *tiles, const StoredImage *image);
void stored_tiles_free(StoredTiles *tiles);

// Returns whether the image has these settings, apart from its finished tiles. Stores the number of
// finished tiles in *tiles.
bool stored_tiles_done(const StoredImage *image, const char *settings_text,
                       const RenderSettings *settings, uint64_t *tiles);

// Lists the image's channels other than its colors in layers. Returns false if the image lacks
// colors or has a channel unknown to --aov.
bool stored_tiles_name_layers(const StoredImage *image, Layers *layers);

bool stored_tiles_has_colors(const StoredImage *image);

// Returns whether the image's channels are exactly the three colors and these layers.
bool stored_tiles_has(const StoredImage *image, const Layers *layers);

// Copies tiles 0 to count - 1: colors to framebuffer, and the channels that layers lists to
// layers->values. The image must have these channels.
void stored_tiles_copy(const RenderSettings *settings, uint64_t count, const StoredImage *image,
                       Framebuffer *framebuffer, Layers *layers);
