// SPDX-License-Identifier: MIT
// Passes pictures from the tracing thread to the window's thread: the latest complete picture, and
// the tiles of the picture in progress.
//
// Invariant: the tracing thread first writes a tile and then counts it under the lock. The window's
// thread reads only counted tiles, and only while it holds the lock.
#pragma once

#include "image/image_file.h"
#include "session/session.h"

#include <pthread.h>

typedef struct {
    Framebuffer framebuffer; // until the layer is complete, only the tracing thread uses it
    unsigned char *bytes;    // 8-bit colors for the window, three bytes per pixel, top row first
    uint64_t pass;           // a new number for each picture or encoding; 0: empty
    RenderSettings settings; // size and tiles of this pass
    uint64_t tiles_done;
    bool is_hidden; // not displayed before it is complete
    bool is_whole;
} Layer;

#define CANVAS_LAYERS 2

typedef struct {
    Layer layers[CANVAS_LAYERS];
    uint64_t passes; // the last of the numbers in Layer::pass
    Encoding encoding;
    pthread_mutex_t mutex;
} Canvas;

void canvas_open(Canvas *canvas, Encoding encoding);
void canvas_close(Canvas *canvas);

// Prepares a layer for a new picture with these settings, and keeps the latest complete picture.
// Returns NULL if memory runs out.
Layer *canvas_begin(Canvas *canvas, const RenderSettings *settings, bool is_hidden, Error *error);

// Encodes the new tiles up to `tiles_done`, with colors multiplied by `gain`, and then counts these
// tiles.
void canvas_add_tiles(Canvas *canvas, Layer *layer, uint64_t tiles_done, double gain);

// Ends a picture. If `is_whole` is true, the layer becomes the latest complete picture. Otherwise,
// the layer becomes empty.
void canvas_end(Canvas *canvas, Layer *layer, bool is_whole);

// Encodes the latest complete picture again, with colors multiplied by `gain`. No other picture may
// be in progress.
void canvas_encode_again(Canvas *canvas, double gain);

// canvas_whole returns the latest complete picture. canvas_unfinished returns the picture in
// progress, unless it is hidden. Both return NULL if there is no such picture. The caller holds the
// lock.
Layer *canvas_whole(Canvas *canvas);
Layer *canvas_unfinished(Canvas *canvas);
