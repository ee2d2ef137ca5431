// SPDX-License-Identifier: MIT
// A model's triangles, kept by OpenGL.
#pragma once

#include "view/draw/light.h"
#include "view/lens.h"
#include "view/model.h"

typedef struct {
    GLuint program, vertices, indices, array;
} TriangleView;

bool triangle_view_open(TriangleView *view, Error *error);
void triangle_view_close(TriangleView *view);

// Hands the model's triangles to OpenGL, instead of those before.
bool triangle_view_load(TriangleView *view, const Model *model, Error *error);

// Draws them, with the uniforms of lens and lights.
void triangle_view_draw(const TriangleView *view, const Model *model, const Lens *lens,
                        const Tone *tone);
