// SPDX-License-Identifier: MIT
// All OpenGL objects of a model, and the drawing order of a frame.
#pragma once

#include "view/draw/boxes.h"
#include "view/draw/canvas.h"
#include "view/draw/model_views.h"
#include "view/draw/ray_view.h"
#include "view/draw/target.h"
#include "view/draw/text_view.h"
#include "view/state.h"

typedef struct {
    Target target;
    TriangleView triangles;
    SphereView spheres;
    LineView boxes, normals;
    RayView rays;
    TextView text;
    bool has_boxes, has_normals; // they match the model and the level
    uint32_t level;
} Views;

// The contents of a frame.
typedef struct {
    const State *state;
    const Model *model;
    bool has_tree; // of the model
    Canvas *canvas;
    Viewpoint camera; // of the picture; a traced one may lag behind the state's
    uint32_t width, height;
    Encoding encoding;
} Frame;

// Makes everything that needs no model, in the current context.  The caller closes the views, also
// after a failure.
bool views_open(Views *views, Error *error);
void views_close(Views *views);

// Switches to another model, which OpenGL copies.
bool views_load(Views *views, const Model *model, Error *error);

// Draws the frame, without text, into the target.
bool views_draw(Views *views, const Frame *frame, Error *error);
