// SPDX-License-Identifier: MIT
// All that OpenGL keeps for a model, and the order in which a frame is drawn from it.
#pragma once

#include "view/boxes.h"
#include "view/canvas.h"
#include "view/line_view.h"
#include "view/ray_view.h"
#include "view/sphere_view.h"
#include "view/state.h"
#include "view/target.h"
#include "view/text_view.h"
#include "view/triangle_view.h"

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
