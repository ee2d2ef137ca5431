// SPDX-License-Identifier: MIT
// The OpenGL objects that draw a model, and the drawing order of a frame.
#pragma once

#include "view/controls.h"
#include "view/draw/ray_view.h"
#include "view/draw/scene_view.h"
#include "view/draw/target.h"
#include "view/draw/text_view.h"

typedef struct {
    Target target;
    Drawing triangles, spheres;
    LineView boxes, normals;
    RayView rays;
    TextView text;
    bool has_boxes, has_normals; // the loaded lines match the model and boxes_depth
    uint32_t boxes_depth;
} Views;

typedef struct {
    const State *state;
    bool is_traced; // the ray-traced picture is displayed
    bool is_moving; // the camera moves, so OpenGL's picture is not anti-aliased
    const Model *model;
    bool has_tree; // the model's tree is built
    Canvas *canvas;
    Viewpoint camera; // camera of the displayed picture, which may lag behind the state
    uint32_t width, height;
    Encoding encoding;
} Frame;

// Makes the objects that need no model, in the current OpenGL context. The caller closes the views,
// even after a failure. A missing font is no failure, but the reason is stored in *no_font.
bool views_open(Views *views, Error *no_font, Error *error);
void views_close(Views *views);

// Copies another model into the OpenGL objects.
void views_load(Views *views, const Model *model);

// Draws the frame without text, and copies it to the window.
bool views_draw(Views *views, const Frame *frame, Error *error);
