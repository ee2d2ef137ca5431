// SPDX-License-Identifier: MIT
// Canvas -> OpenGL: the traced picture, and over it the tiles of the one that is being traced.
#pragma once

#include "view/draw/canvas.h"
#include "view/draw/shader.h"

// What of a layer OpenGL has.
typedef struct {
    GLuint texture;
    uint64_t pass, revision, tiles;
    uint32_t width, height;
} LayerCopy;

typedef struct {
    GLuint program, array;
    LayerCopy copies[CANVAS_LAYERS];
} RayView;

bool ray_view_open(RayView *view, Error *error);
void ray_view_close(RayView *view);

// Draws over all of the target, which is of that size.
void ray_view_draw(RayView *view, Canvas *canvas, uint32_t width, uint32_t height);
