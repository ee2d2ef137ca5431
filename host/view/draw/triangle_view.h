// SPDX-License-Identifier: MIT
// A model's triangles in OpenGL buffers.
#pragma once

#include "view/draw/light.h"
#include "view/lens.h"
#include "view/model.h"

typedef struct {
    GLuint program, vertices, indices, array;
} TriangleView;

bool triangle_view_open(TriangleView *view, Error *error);
void triangle_view_close(TriangleView *view);

// Copies the model's triangles into the OpenGL buffers, in place of the previous triangles.
bool triangle_view_load(TriangleView *view, const Model *model, Error *error);

// Draws the triangles as seen through lens, with colors converted by tone.
void triangle_view_draw(const TriangleView *view, const Model *model, const Lens *lens,
                        const Tone *tone);
