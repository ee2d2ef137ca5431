// SPDX-License-Identifier: MIT
// The inside of a ClrtRenderer: a device with compiled kernels, and the latest scene in the
// device's layout.
#pragma once

#include "library/scene_handle.h"
#include "render/renderer.h"

#include <stdatomic.h>

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
