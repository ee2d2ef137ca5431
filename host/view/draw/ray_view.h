// SPDX-License-Identifier: MIT
// Draws a canvas with OpenGL: the latest traced picture, covered by the finished tiles of the next
// picture.
#pragma once

#include "view/draw/canvas.h"

#include <epoxy/gl.h>

// OpenGL's copy of a layer.
typedef struct {
    GLuint texture, frame; // `frame` is a framebuffer that reads `texture`
    uint64_t pass, tiles;
} LayerCopy;

typedef struct {
    LayerCopy copies[CANVAS_LAYERS];
} RayView;

void ray_view_open(RayView *view);
void ray_view_close(RayView *view);

// Draws the canvas over the whole target, which has width x height pixels.
void ray_view_draw(RayView *view, Canvas *canvas, uint32_t width, uint32_t height);
