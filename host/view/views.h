// SPDX-License-Identifier: MIT
// All that OpenGL keeps for a model, and the order in which a frame is drawn from it.
#pragma once

#include "view/draw/boxes.h"
#include "view/draw/canvas.h"
#include "view/draw/line_view.h"
#include "view/draw/ray_view.h"
#include "view/draw/sphere_view.h"
#include "view/draw/target.h"
#include "view/draw/text_view.h"
#include "view/draw/triangle_view.h"
#include "view/state.h"

typedef struct {
    Target target;
    TriangleView triangles;
    SphereView spheres;
    LineView boxes, normals;
    RayView rays;
    TextView text;
    bool has_boxes, has_normals; // they are those of the model and the level
    uint32_t level;
} Views;

// What a frame shows.
typedef struct {
    const State *state;
    const Model *model;
    bool has_tree; // of the model
    Canvas *canvas;
    Viewpoint camera; // of the picture: the traced one may lag behind the state's
    uint32_t width, height;
    Encoding encoding;
} Frame;

// Makes everything that needs no model, in the context that is current.  To be closed in either
// case.
bool views_open(Views *views, Error *error);
void views_close(Views *views);

// Takes another model, of which OpenGL keeps copies.
bool views_load(Views *views, const Model *model, Error *error);

// Draws the frame and shows it in the window, without text.
bool views_draw(Views *views, const Frame *frame, Error *error);
