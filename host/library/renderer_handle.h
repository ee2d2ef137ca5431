// SPDX-License-Identifier: MIT
// What a ClrtRenderer is to the rest of the library: a device with compiled kernels, and the scene
// that it drew last, as the device reads it.
#pragma once

#include "library/scene_handle.h"
#include "render/renderer.h"

#include <stdatomic.h>

struct ClrtRenderer {
    Device device;
    Cache cache;
    RendererSetup setup;
    ReadyKernel kernel; // lent to each scene's renderer
    uint32_t threads;
    atomic_bool is_busy; // with a picture
    uint64_t state;      // of the scene that follows; 0 for none
    Normalization normalization;
    FlatScene flat;
    Renderer renderer;
};

// Makes scene the one that is drawn, unless it is already.
bool renderer_handle_take(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error);
