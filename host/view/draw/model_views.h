// SPDX-License-Identifier: MIT
// A model's triangles, spheres and boxes in OpenGL buffers.
#pragma once

#include "accel/bvh.h"
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

// Spheres, exact in every pixel.
typedef struct {
    GLuint program, corners, spheres, array;
    ARRAY(float) numbers; // of all spheres, in OpenGL's layout
} SphereView;

bool sphere_view_open(SphereView *view, Error *error);
void sphere_view_close(SphereView *view);

// Allocates memory for the model's spheres.
bool sphere_view_load(SphereView *view, const Model *model, Error *error);

void sphere_view_draw(SphereView *view, const Model *model, const Lens *lens, const Tone *tone);

// Boxes, or their diagonals, in one color.
typedef struct {
    GLuint program, corners, boxes, array;
    bool is_diagonal;
    uint32_t count; // of loaded boxes
} LineView;

// With is_diagonal, draws a line from each box's low corner to its high one, in any direction.
bool line_view_open(LineView *view, bool is_diagonal, Error *error);
void line_view_close(LineView *view);

void line_view_load(LineView *view, const Box *boxes, size_t count);
void line_view_draw(const LineView *view, const Lens *lens, const float color[3]);
