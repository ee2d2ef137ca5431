// SPDX-License-Identifier: MIT
// The inside of a ClrtScene and of a ClrtRenderer.
#pragma once

#include "library/clrt.h"
#include "render/renderer.h"
#include "scene/scene.h"

#include <stdatomic.h>

struct ClrtScene {
    Scene scene;
    uint64_t state; // a number unique to the scene and its latest change
};

// Ends a change.  If it went well, renderers will notice it; otherwise error receives the cause.
bool scene_handle_changed(ClrtScene *scene, bool ok, const Error *cause, ClrtError *error);

// Fails with CLRT_ARGUMENT if the scene has no such material.
bool scene_handle_check_material(const ClrtScene *scene, uint32_t number, ClrtError *error);

// Fails with CLRT_ARGUMENT if the camera is invalid.
bool scene_handle_take_camera(Viewpoint *viewpoint, const ClrtCamera *camera, ClrtError *error);

// The inside of a ClrtRenderer: a device with compiled kernels, and the latest scene in the
// device's layout.
struct ClrtRenderer {
    Device device;
    Cache cache;
    RendererSetup setup;
    ReadyKernel kernel; // lent to the renderer of each scene
    uint32_t threads;
    atomic_bool is_busy; // drawing a picture
    uint64_t state;      // of the scene below; 0 for none
    Normalization normalization;
    FlatScene flat;
    Renderer renderer;
};

// Loads the scene, unless it is the current one.
bool renderer_handle_take(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error);
