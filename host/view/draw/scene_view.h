// SPDX-License-Identifier: MIT
// Draws a model's triangles, spheres and normals, and the boxes of its tree, by OpenGL.
#pragma once

#include "base/array.h"
#include "view/draw/drawing.h"
#include "view/model.h"

bool triangle_view_open(Drawing *view, Error *error);

// Copies the model's triangles into the OpenGL buffers, in place of the previous triangles.
void triangle_view_load(const Drawing *view, const Model *model);

// Draws the triangles as seen through *lens, with colors converted by *tone.
void triangle_view_draw(const Drawing *view, const Model *model, const Lens *lens,
                        const Tone *tone);

bool sphere_view_open(Drawing *view, Error *error);

// Draws the spheres by casting a ray in each pixel, so their outlines are exact. If memory runs
// out, draws nothing.
void sphere_view_draw(const Drawing *view, const Model *model, const Lens *lens, const Tone *tone);

// A view that draws boxes, or diagonals of boxes, in one color.
typedef struct {
    Drawing drawing;
    bool is_diagonal;
    uint32_t count; // of loaded boxes
} LineView;

// If `is_diagonal` is true, the view draws a line from each box's `low` to its `high`, and `low`
// may exceed `high`.
bool line_view_open(LineView *view, bool is_diagonal, Error *error);

void line_view_load(LineView *view, const Box *boxes, size_t count);
void line_view_draw(const LineView *view, const Lens *lens, const float color[3]);

// The boxes that a LineView draws: boxes at one depth of a Bvh, or normals as diagonals of boxes.
typedef ARRAY(Box) Boxes;

// Returns the depth of the deepest inner nodes, or 0 without inner nodes.
uint32_t boxes_deepest(const Bvh *bvh);

// Fills an empty array with the boxes of the inner nodes at this depth. The root has depth 1. If
// `depth` is 0, fills the array with the boxes of all leaves. The caller frees the array, also
// after a failure.
bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t depth, Error *error);
void boxes_free(Boxes *boxes);

// Fills an empty array with the normals of a model in normalized coordinates. Each normal is the
// line from a box's `low` to its `high`. The lines start at the vertices of smooth objects, and at
// the centers of the triangles of other objects. The caller frees the array, also after a failure.
bool boxes_of_normals(Boxes *lines, const Model *model, Error *error);
