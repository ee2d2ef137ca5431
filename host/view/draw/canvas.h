// SPDX-License-Identifier: MIT
// The pictures passed from the tracing thread to the window's thread: the latest complete one, and
// the one in progress, tile by tile.  The tracing thread writes a tile and then counts it under the
// lock.  The window's thread holds the lock while it reads counted tiles.
#pragma once

#include "image/image_file.h"
#include "render/tile.h"

#include <pthread.h>

typedef struct {
    Framebuffer framebuffer; // only for the tracing thread until the layer is complete
    unsigned char *bytes;    // for the window: three per pixel, top row first
    uint64_t pass;           // number of the pass that fills the layer, ascending; 0: empty
    RenderSettings settings; // of that pass: size and tiles
    uint64_t tiles_done;
    uint64_t revision; // counts re-encodings of the counted tiles' bytes
    bool is_hidden;    // not displayed before it is complete
    bool is_whole;
} Layer;

#define CANVAS_LAYERS 2

typedef struct {
    Layer layers[CANVAS_LAYERS];
    uint64_t passes; // passes begun
    Encoding encoding;
    pthread_mutex_t mutex;
} Canvas;

void canvas_open(Canvas *canvas, Encoding encoding);
void canvas_close(Canvas *canvas);

// Prepares the layer that is not the latest complete one for a picture of that size.  Returns NULL
// without memory.
Layer *canvas_begin(Canvas *canvas, const RenderSettings *settings, bool is_hidden, Error *error);

// Encodes the tiles up to tiles_done, with colors multiplied by gain, and counts them.
void canvas_add_tiles(Canvas *canvas, Layer *layer, uint64_t tiles_done, double gain);

// Marks the layer complete, which makes it the latest picture.
void canvas_finish(Canvas *canvas, Layer *layer);

// Marks the layer empty.
void canvas_drop(Canvas *canvas, Layer *layer);

// Encodes the latest complete picture again.
void canvas_encode_again(Canvas *canvas, double gain);

// Return the latest complete picture, and the one in progress to be displayed above it; NULL for
// none.  The caller holds the lock.
Layer *canvas_whole(Canvas *canvas);
Layer *canvas_unfinished(Canvas *canvas);
