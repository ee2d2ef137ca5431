// SPDX-License-Identifier: MIT
// The canvas has two layers. One layer contains the latest complete picture. The next pass fills
// the other layer.
#include "view/draw/canvas.h"

#include <stdlib.h>

void canvas_open(Canvas *canvas, Encoding encoding)
{
    *canvas = (Canvas){.encoding = encoding};
    pthread_mutex_init(&canvas->mutex, NULL);
}

static void free_layer(Layer *layer)
{
    framebuffer_free(&layer->framebuffer);
    free(layer->bytes);
    *layer = (Layer){0};
}

void canvas_close(Canvas *canvas)
{
    for (int layer = 0; layer < CANVAS_LAYERS; layer++)
        free_layer(&canvas->layers[layer]);
    pthread_mutex_destroy(&canvas->mutex);
}

Layer *canvas_whole(Canvas *canvas)
{
    Layer *latest = NULL;
    for (int place = 0; place < CANVAS_LAYERS; place++) {
        Layer *layer = &canvas->layers[place];
        if (layer->is_whole && (latest == NULL || layer->pass > latest->pass))
            latest = layer;
    }
    return latest;
}

Layer *canvas_unfinished(Canvas *canvas)
{
    for (int place = 0; place < CANVAS_LAYERS; place++)
        if (canvas->layers[place].pass > 0 && !canvas->layers[place].is_whole &&
            !canvas->layers[place].is_hidden)
            return &canvas->layers[place];
    return NULL;
}

static bool make_room(Layer *layer, const RenderSettings *settings, Error *error)
{
    const Framebuffer *held = &layer->framebuffer;
    if (held->pixels != NULL && held->width == settings->width && held->height == settings->height)
        return true;
    free_layer(layer);
    layer->bytes = memory_raw((size_t)settings->width * settings->height, 3, error);
    if (layer->bytes != NULL &&
        framebuffer_make(&layer->framebuffer, settings->width, settings->height, error))
        return true;
    free_layer(layer);
    return false;
}

Layer *canvas_begin(Canvas *canvas, const RenderSettings *settings, bool is_hidden, Error *error)
{
    pthread_mutex_lock(&canvas->mutex);
    Layer *layer = &canvas->layers[0];
    if (layer == canvas_whole(canvas))
        layer = &canvas->layers[1];
    const bool ok = make_room(layer, settings, error);
    if (ok) {
        layer->pass = ++canvas->passes;
        layer->settings = *settings;
        layer->tiles_done = 0;
        layer->is_hidden = is_hidden;
        layer->is_whole = false;
    }
    pthread_mutex_unlock(&canvas->mutex);
    return ok ? layer : NULL;
}

static void encode_row(const Canvas *canvas, Layer *layer, size_t first, size_t count, double gain)
{
    framebuffer_encode(layer->framebuffer.pixels[first], 3 * count, canvas->encoding, gain,
                       layer->bytes + 3 * first);
}

static void encode_tile(const Canvas *canvas, Layer *layer, const Tile *tile, double gain)
{
    for (uint32_t row = 0; row < tile->height; row++)
        encode_row(canvas, layer, (size_t)(tile->y + row) * layer->settings.width + tile->x,
                   tile->width, gain);
}

void canvas_add_tiles(Canvas *canvas, Layer *layer, uint64_t tiles_done, double gain)
{
    for (uint64_t number = layer->tiles_done; number < tiles_done; number++) {
        const Tile tile = tile_at(&layer->settings, number);
        encode_tile(canvas, layer, &tile, gain);
    }
    pthread_mutex_lock(&canvas->mutex);
    layer->tiles_done = tiles_done;
    pthread_mutex_unlock(&canvas->mutex);
}

void canvas_end(Canvas *canvas, Layer *layer, bool is_whole)
{
    pthread_mutex_lock(&canvas->mutex);
    layer->is_whole = is_whole;
    if (!is_whole)
        layer->pass = 0;
    pthread_mutex_unlock(&canvas->mutex);
}

void canvas_encode_again(Canvas *canvas, double gain)
{
    pthread_mutex_lock(&canvas->mutex);
    Layer *layer = canvas_whole(canvas);
    const size_t count = layer == NULL ? 0 : (size_t)layer->settings.width * layer->settings.height;
    if (count > 0) {
        encode_row(canvas, layer, 0, count, gain);
        layer->pass = ++canvas->passes;
    }
    pthread_mutex_unlock(&canvas->mutex);
}
