// SPDX-License-Identifier: MIT
// Device, model and pass -> picture: what the thread that traces keeps open.
#pragma once

#include "render/renderer.h"
#include "view/model.h"
#include "view/plan.h"

typedef struct {
    const char *device; // as for device_open
    KernelRequest kernel;
    Specialization specialization;
    BvhBuilder builder;
    uint32_t group_width, group_height; // 0: what suits the kernels
    int64_t max_level;                  // negative: the scene's
    uint32_t threads;                   // of the host's own work
    const char *kernel_folder;          // NULL: the embedded kernels
    const Cache *cache;
} TracerOptions;

typedef struct {
    const TracerOptions *options;
    Device device;
    RendererSetup setup;
    uint32_t group[2];
    Model *model; // that is drawn, held; NULL while there is none
    bool uses_bvh;
    FlatScene flat;
    Renderer renderer;
    Renderer counter; // the same with counters, opened when it is first wanted
} Tracer;

// Opens the device.  The options outlive the tracer, which is to be closed in either case.
bool tracer_open(Tracer *tracer, const TracerOptions *options, Error *error);
void tracer_close(Tracer *tracer);

// How trees are to be built for the device.
BvhSettings tracer_tree(const Tracer *tracer);

// Draws that model from now on, with its tree or by brute force.  Where that fails, it goes on with
// what it had.
bool tracer_take(Tracer *tracer, Model *model, bool uses_bvh, Error *error);

// What is drawn: a pass of the picture that a viewpoint has.
typedef struct {
    const Viewpoint *camera;
    const Pass *pass;
} Shot;

// The settings of a pass's picture.
RenderSettings tracer_settings(const Tracer *tracer, const Pass *pass);

// Draws into framebuffer, which has the settings' size, as far as the observer lets it.
bool tracer_draw(Tracer *tracer, const Shot *shot, const RenderObserver *observer,
                 Framebuffer *framebuffer, Error *error);

// How far the latest pass came, and what it cost.
const RenderProgress *tracer_progress(const Tracer *tracer, const Pass *pass);
