// SPDX-License-Identifier: MIT
// Model, camera and pass -> picture. Only the worker thread calls these functions.
#pragma once

#include "explain/report.h"
#include "session/request.h"
#include "view/model.h"
#include "view/plan.h"

typedef struct {
    SessionSettings session;
    Cache cache;
    int32_t max_level; // as ClrtPicture::max_level
} TracerOptions;

typedef struct {
    const TracerOptions *options;
    Session session;
    Model *model;        // the current model, with a reference; may be NULL
    PictureResult drawn; // the latest picture
} ViewTracer;

// Opens the device. The options must outlive the tracer. The caller closes the tracer, even after a
// failure.
bool tracer_open(ViewTracer *tracer, const TracerOptions *options, Error *error);
void tracer_close(ViewTracer *tracer);

// Returns the settings of the trees that the device's kernels traverse.
BvhSettings tracer_tree(const ViewTracer *tracer);

// Switches to the model and adds a reference to it. If uses_bvh is false, rays test all triangles
// instead of using the model's tree. On failure, the tracer keeps the previous model.
bool tracer_take(ViewTracer *tracer, Model *model, bool uses_bvh, Error *error);

// Compiles the kernels again, from the kernel folder if there is one. On failure, the tracer keeps
// the previous kernels.
bool tracer_renew(ViewTracer *tracer, Error *error);

// A picture to draw: a camera and a pass.
typedef struct {
    const Viewpoint *camera;
    const Pass *pass;
} Shot;

// Returns the settings of a pass's picture.
RenderSettings tracer_settings(const ViewTracer *tracer, const Pass *pass);

// Draws the shot into framebuffer, which must have the size of tracer_settings. Stops when the
// observer returns false.
bool tracer_draw(ViewTracer *tracer, const Shot *shot, const RenderObserver *observer,
                 Framebuffer *framebuffer, Error *error);

// Writes the explanation of a pixel of the shot. `head` provides pixel, encoding and is_brief.
bool tracer_explain(ViewTracer *tracer, const Shot *shot, const ExplainReport *head, FILE *stream,
                    Error *error);
