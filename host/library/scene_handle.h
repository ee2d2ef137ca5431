// SPDX-License-Identifier: MIT
// What a ClrtScene is to the rest of the library.
#pragma once

#include "library/clrt.h"
#include "scene/scene.h"

struct ClrtScene {
    Scene scene;
    uint64_t state; // a number that it shares with no other scene, nor with itself before a change
};

// Ends a change: renderers will see it, or where it went wrong, error tells why.
bool scene_handle_changed(ClrtScene *scene, bool ok, const Error *cause, ClrtError *error);

// Fails with CLRT_ARGUMENT where the scene has no such material.
bool scene_handle_check_material(const ClrtScene *scene, uint32_t number, ClrtError *error);

// Fails with CLRT_ARGUMENT where no such camera can be.
bool scene_handle_take_camera(Viewpoint *viewpoint, const ClrtCamera *camera, ClrtError *error);
