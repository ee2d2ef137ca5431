// SPDX-License-Identifier: MIT
// Copies the canvas's layers into textures, and blits the textures. Only new tiles are uploaded. A
// picture with the target's size is not filtered.
#include "view/draw/ray_view.h"

void ray_view_open(RayView *view)
{
    *view = (RayView){0};
    for (int layer = 0; layer < CANVAS_LAYERS; layer++) {
        LayerCopy *copy = &view->copies[layer];
        glGenTextures(1, &copy->texture);
        glGenFramebuffers(1, &copy->frame);
        glBindTexture(GL_TEXTURE_2D, copy->texture);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, copy->frame);
        glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                               copy->texture, 0);
    }
}

void ray_view_close(RayView *view)
{
    for (int layer = 0; layer < CANVAS_LAYERS; layer++) {
        glDeleteFramebuffers(1, &view->copies[layer].frame);
        glDeleteTextures(1, &view->copies[layer].texture);
    }
    *view = (RayView){0};
}

static void copy_tile(const Layer *layer, const Tile *tile)
{
    const size_t first = (size_t)tile->y * layer->settings.width + tile->x;
    glTexSubImage2D(GL_TEXTURE_2D, 0, (GLint)tile->x, (GLint)tile->y, (GLsizei)tile->width,
                    (GLsizei)tile->height, GL_RGB, GL_UNSIGNED_BYTE, layer->bytes + 3 * first);
}

// Updates the copy from the layer. The caller holds the canvas's lock.
static void update_copy(LayerCopy *copy, const Layer *layer)
{
    const RenderSettings *settings = &layer->settings;
    glBindTexture(GL_TEXTURE_2D, copy->texture);
    if (copy->pass != layer->pass) {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, (GLsizei)settings->width,
                     (GLsizei)settings->height, 0, GL_RGB, GL_UNSIGNED_BYTE, NULL);
        copy->pass = layer->pass;
        copy->tiles = 0;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, (GLint)settings->width);
    for (; copy->tiles < layer->tiles_done; copy->tiles++) {
        const Tile tile = tile_at(settings, copy->tiles);
        copy_tile(layer, &tile);
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

// Blits the picture's columns [0, right) and rows [top, bottom) to the target, which has the same
// size. The picture's first row is at the top, and the target's first row is at the bottom.
static void blit_part(const Layer *layer, GLint top, GLint right, GLint bottom)
{
    const GLint height = (GLint)layer->settings.height;
    glBlitFramebuffer(0, top, right, bottom, 0, height - top, right, height - bottom,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

// Draws the complete rows of tiles, and the finished part of the next row.
static void draw_done(const Layer *layer)
{
    const RenderSettings *settings = &layer->settings;
    const GLint width = (GLint)settings->width, height = (GLint)settings->height;
    const uint32_t columns = (settings->width + settings->tile_width - 1) / settings->tile_width;
    const GLint rows = (GLint)(layer->tiles_done / columns * settings->tile_height);
    const GLint part = (GLint)(layer->tiles_done % columns * settings->tile_width);
    const GLint done = rows < height ? rows : height;
    const GLint next = done + (GLint)settings->tile_height;
    blit_part(layer, 0, width, done);
    blit_part(layer, done, part, next < height ? next : height);
}

static bool has_size(const Layer *layer, uint32_t width, uint32_t height)
{
    return layer->settings.width == width && layer->settings.height == height;
}

static void draw_layer(LayerCopy *copy, const Layer *layer, uint32_t width, uint32_t height)
{
    update_copy(copy, layer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, copy->frame);
    if (has_size(layer, width, height))
        draw_done(layer);
    else
        glBlitFramebuffer(0, 0, (GLint)layer->settings.width, (GLint)layer->settings.height, 0,
                          (GLint)height, (GLint)width, 0, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

void ray_view_draw(RayView *view, Canvas *canvas, uint32_t width, uint32_t height)
{
    pthread_mutex_lock(&canvas->mutex);
    const Layer *whole = canvas_whole(canvas), *unfinished = canvas_unfinished(canvas);
    if (whole != NULL)
        draw_layer(&view->copies[whole - canvas->layers], whole, width, height);
    if (unfinished != NULL && has_size(unfinished, width, height))
        draw_layer(&view->copies[unfinished - canvas->layers], unfinished, width, height);
    pthread_mutex_unlock(&canvas->mutex);
}
