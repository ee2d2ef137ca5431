// SPDX-License-Identifier: MIT
// The pictures that pass from the thread that traces to the one that shows: the latest whole one,
// and the one that is being traced, tile by tile.  The tracing thread writes a tile first and then
// counts it under the lock; who shows holds the lock while it reads tiles that are counted.
#pragma once

#include "image/image_file.h"
#include "render/tile.h"

#include <pthread.h>

typedef struct {
    Framebuffer framebuffer; // the tracing thread's alone until the layer is whole
    unsigned char *bytes;    // of the window: three a pixel, the top row first
    uint64_t pass;           // number of the pass that fills it, ascending; 0: holds nothing
    RenderSettings settings; // of that pass: size and tiles
    uint64_t tiles_done;
    uint64_t revision; // of the bytes of tiles that were counted before
    bool is_hidden;    // to be shown once it is whole
    bool is_whole;
} Layer;

#define CANVAS_LAYERS 2

typedef struct {
    Layer layers[CANVAS_LAYERS];
    uint64_t passes; // begun
    Encoding encoding;
    pthread_mutex_t mutex;
} Canvas;

void canvas_open(Canvas *canvas, Encoding encoding);
void canvas_close(Canvas *canvas);

// Makes room for a picture of that size in the layer that is not the latest whole one, and returns
// it; NULL where memory ran out.
Layer *canvas_begin(Canvas *canvas, const RenderSettings *settings, bool is_hidden, Error *error);

// Encodes the tiles up to tiles_done, of colors times gain, and counts them.
void canvas_add_tiles(Canvas *canvas, Layer *layer, uint64_t tiles_done, double gain);

// The layer's picture is whole: from now on the latest.
void canvas_finish(Canvas *canvas, Layer *layer);

// The layer holds nothing worth showing.
void canvas_drop(Canvas *canvas, Layer *layer);

// Encodes the latest whole picture again.
void canvas_encode_again(Canvas *canvas, double gain);

// The latest whole picture, and the one that is traced to be shown above it; NULL where there is
// none.  Under the lock.
Layer *canvas_whole(Canvas *canvas);
Layer *canvas_unfinished(Canvas *canvas);
