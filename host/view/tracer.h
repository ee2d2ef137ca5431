// SPDX-License-Identifier: MIT
// Device, model and pass -> picture, on the tracing thread.
#pragma once

#include "explain/explainer.h"
#include "render/renderer.h"
#include "view/model.h"
#include "view/plan.h"

typedef struct {
    const char *device; // for device_open
    KernelRequest kernel;
    Specialization specialization;
    BvhBuilder builder;
    uint32_t group_width, group_height; // 0: the kernels' default
    int64_t max_level;                  // negative: the scene's
    uint32_t threads;                   // threads on the host
    const char *kernel_folder;          // NULL: the embedded kernels
    const Cache *cache;
} TracerOptions;

typedef struct {
    const TracerOptions *options;
    Device device;
    RendererSetup setup;
    uint32_t group[2];
    Model *model; // the current model, with a reference; may be NULL
    FlatScene flat;
    Renderer renderer;
    Renderer counter; // the renderer for PASS_COUNT, opened on first use
} Tracer;

// Opens the device. The options must outlive the tracer. The caller closes the tracer, even after a
// failure.
bool tracer_open(Tracer *tracer, const TracerOptions *options, Error *error);
void tracer_close(Tracer *tracer);

// Returns the settings for trees that suit the device.
BvhSettings tracer_tree(const Tracer *tracer);

// Switches to the model, to be traced with its tree or by brute force. On failure, the tracer keeps
// the previous model.
bool tracer_take(Tracer *tracer, Model *model, bool uses_bvh, Error *error);

// Saves new programs to the cache, which takes about a second.
void tracer_save(Tracer *tracer);

// Returns whether tracer_save has nothing to do.
bool tracer_is_saved(const Tracer *tracer);

// A picture to draw: a camera and a pass.
typedef struct {
    const Viewpoint *camera;
    const Pass *pass;
} Shot;

// Returns the settings of a pass's picture.
RenderSettings tracer_settings(const Tracer *tracer, const Pass *pass);

// Draws the shot into framebuffer until the observer returns false. framebuffer must have the size
// of tracer_settings.
bool tracer_draw(Tracer *tracer, const Shot *shot, const RenderObserver *observer,
                 Framebuffer *framebuffer, Error *error);

// Writes the explanation of a pixel of the shot. head provides pixel, encoding and is_brief.
bool tracer_explain(Tracer *tracer, const Shot *shot, const ExplainReport *head, FILE *stream,
                    Error *error);

// Returns the progress and counters of a pass that tracer_draw has just drawn.
const RenderProgress *tracer_progress(const Tracer *tracer, const Pass *pass);
