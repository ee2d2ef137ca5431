// SPDX-License-Identifier: MIT
// The contents of a ClrtRenderer: a device with compiled kernels, and the latest scene in the
// device's layout.
#pragma once

#include "library/scene_handle.h"
#include "render/renderer.h"

#include <stdatomic.h>

struct ClrtRenderer {
    Device device;
    Cache cache;
    RendererSetup setup;
    ReadyKernel kernel; // shared with the Renderer of each scene
    uint32_t threads;
    atomic_bool is_busy; // true while a picture is drawn
    uint64_t state;      // ClrtScene::state of the uploaded scene; 0 without a scene
    Normalization normalization;
    FlatScene flat;
    Renderer renderer;
};

// Uploads the scene, unless the renderer already has the scene in this state.
bool renderer_handle_take(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error);
