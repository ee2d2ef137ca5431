// SPDX-License-Identifier: MIT
// A model's triangles and spheres, the boxes of its tree and its normals, drawn by OpenGL.
#pragma once

#include "base/array.h"
#include "view/draw/shader.h"
#include "view/model.h"

bool triangle_view_open(Drawing *view, Error *error);

// Copies the model's triangles into the OpenGL buffers, in place of the previous triangles.
bool triangle_view_load(const Drawing *view, const Model *model, Error *error);

// Draws the triangles as seen through lens, with colors converted by tone.
void triangle_view_draw(const Drawing *view, const Model *model, const Lens *lens,
                        const Tone *tone);

// Draws spheres that are exact in every pixel.
typedef struct {
    Drawing drawing;
    ARRAY(float) numbers; // of all spheres, in OpenGL's layout
} SphereView;

bool sphere_view_open(SphereView *view, Error *error);
void sphere_view_close(SphereView *view);

// Allocates memory for the model's spheres.
bool sphere_view_load(SphereView *view, const Model *model, Error *error);

void sphere_view_draw(SphereView *view, const Model *model, const Lens *lens, const Tone *tone);

// Draws boxes, or their diagonals, in one color.
typedef struct {
    Drawing drawing;
    bool is_diagonal;
    uint32_t count; // of loaded boxes
} LineView;

// With is_diagonal, the view draws lines from `low` to `high`. Either may be larger.
bool line_view_open(LineView *view, bool is_diagonal, Error *error);

void line_view_load(LineView *view, const Box *boxes, size_t count);
void line_view_draw(const LineView *view, const Lens *lens, const float color[3]);

// The boxes that a LineView draws: those of one level of a Bvh, or a model's normals as diagonals.
typedef ARRAY(Box) Boxes;

// Returns the number of levels of inner nodes.
uint32_t boxes_levels(const Bvh *bvh);

// Fills an empty array with the boxes of a level: 0 for the leaves, 1 for the root, and higher
// levels for deeper inner nodes. The caller frees the boxes, also after a failure.
bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t level, Error *error);
void boxes_free(Boxes *boxes);

// Fills an empty array with the normals of a model, as lines from low to high in normalized
// coordinates. The lines start at the vertices of smooth objects, and at the centers of the
// triangles of other objects. The caller frees the array, also after a failure.
bool normals_make(Boxes *lines, const Model *model, Error *error);
