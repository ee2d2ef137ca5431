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

// Ends a change. If ok, gives the scene a new state, which renderers notice. Otherwise, error
// receives the cause.
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
