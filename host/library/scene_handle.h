// SPDX-License-Identifier: MIT
// The inside of a ClrtScene.
#pragma once

#include "library/clrt.h"
#include "scene/scene.h"

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
