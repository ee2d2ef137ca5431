// SPDX-License-Identifier: MIT
// A picture file that clrt wrote some tiles of -> which those are, and the tiles in their place.
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

// Reads what the image's texts say of its tiles; false where they say nothing that fits it.  They
// come from a file and are believed no further.
bool stored_tiles_read(StoredTiles *tiles, const StoredImage *image);
void stored_tiles_free(StoredTiles *tiles);

// Whether settings are those of the image's, but for the tiles that are done of it, which are left
// in *tiles.
bool stored_tiles_done(const StoredImage *image, const char *settings_text,
                       const RenderSettings *settings, uint64_t *tiles);

// Names the image's channels beside its colors; false where it has no colors, or a channel that
// --aov does not draw.
bool stored_tiles_name_layers(const StoredImage *image, Layers *layers);

bool stored_tiles_has_colors(const StoredImage *image);

// Whether the image has three colors, those layers and nothing else.
bool stored_tiles_has(const StoredImage *image, const Layers *layers);

// Copies the first count tiles of those settings: colors, which the image has, into framebuffer and
// the channels of layers, which it has too, into those.
void stored_tiles_copy(const RenderSettings *settings, uint64_t count, const StoredImage *image,
                       Framebuffer *framebuffer, Layers *layers);
