// SPDX-License-Identifier: MIT
// Copies the canvas's layers into textures and draws them. Only new tiles are uploaded. A picture
// with the target's size is drawn without filtering.
#include "view/draw/ray_view.h"

bool ray_view_open(RayView *view, Error *error)
{
    static const DrawingLayout layout = {.shader = shader_picture};
    *view = (RayView){0};
    for (int layer = 0; layer < CANVAS_LAYERS; layer++) {
        glGenTextures(1, &view->copies[layer].texture);
        glBindTexture(GL_TEXTURE_2D, view->copies[layer].texture);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    return drawing_open(&view->drawing, &layout, error);
}

void ray_view_close(RayView *view)
{
    for (int layer = 0; layer < CANVAS_LAYERS; layer++)
        glDeleteTextures(1, &view->copies[layer].texture);
    drawing_close(&view->drawing);
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
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, (GLsizei)settings->width, (GLsizei)settings->height,
                     0, GL_RGB, GL_UNSIGNED_BYTE, NULL);
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

static void draw_part(GLint x, GLint y, GLint width, GLint height)
{
    glScissor(x, y, width, height);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
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
    draw_part(0, height - done, width, done);
    const GLint next = done + (GLint)settings->tile_height;
    const GLint bottom = next < height ? next : height;
    draw_part(0, height - bottom, part, bottom - done);
}

static bool has_size(const Layer *layer, uint32_t width, uint32_t height)
{
    return layer->settings.width == width && layer->settings.height == height;
}

static void draw_layer(LayerCopy *copy, const Layer *layer, uint32_t width, uint32_t height)
{
    const bool is_exact = has_size(layer, width, height);
    update_copy(copy, layer);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, is_exact ? GL_NEAREST : GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, is_exact ? GL_NEAREST : GL_LINEAR);
    if (is_exact)
        draw_done(layer);
    else
        draw_part(0, 0, (GLint)width, (GLint)height);
}

void ray_view_draw(RayView *view, Canvas *canvas, uint32_t width, uint32_t height)
{
    pthread_mutex_lock(&canvas->mutex);
    const Layer *whole = canvas_whole(canvas), *unfinished = canvas_unfinished(canvas);
    drawing_use(&view->drawing);
    glEnable(GL_SCISSOR_TEST);
    if (whole != NULL)
        draw_layer(&view->copies[whole - canvas->layers], whole, width, height);
    if (unfinished != NULL && has_size(unfinished, width, height))
        draw_layer(&view->copies[unfinished - canvas->layers], unfinished, width, height);
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(0);
    pthread_mutex_unlock(&canvas->mutex);
}
