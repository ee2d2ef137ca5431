// SPDX-License-Identifier: MIT
// Defines ClrtScene and ClrtRenderer, and declares checks of the callers' arguments.
#pragma once

#include "base/error.h"
#include "library/clrt.h"
#include "scene/scene.h"
#include "session/picture.h"
#include "session/ray_caster.h"

#include <stdatomic.h>

// The argument functions validate the callers' arguments. Code outside host/library mostly asserts
// its requirements.

// Fills *error unless `error` is NULL, and returns false.
__attribute__((format(printf, 3, 4))) bool library_fail(ClrtError *error, ClrtFault fault,
                                                        const char *format, ...);

// Calls library_fail with the message of *cause.
bool library_fail_for(ClrtError *error, ClrtFault fault, const Error *cause);

// These functions return false with CLRT_ARGUMENT if an argument is invalid. `what` is the
// argument's name in messages. Components of vectors must be in [-most, most], and components of
// colors in [0, 1].
bool argument_given(ClrtError *error, const char *what, const void *pointer);
bool argument_number(ClrtError *error, const char *what, double number, double low, double high);
bool argument_vector(ClrtError *error, const char *what, const double vector[3], double most);
bool argument_color(ClrtError *error, const char *what, const double color[3]);

// Copies a struct of clrt.h into `copy`, which has `size` bytes. If the given struct is shorter,
// the missing members become zero. If the given struct is longer, its additional members must be
// zero.
bool argument_struct(ClrtError *error, const char *what, const void *given, void *copy,
                     size_t size);

// Copies a filled struct of `size` bytes into the given struct, without the members that the given
// struct lacks. Fails as argument_struct does.
bool argument_fill(ClrtError *error, const char *what, void *given, const void *filled,
                   size_t size);

struct ClrtScene {
    Scene scene;
    uint64_t state; // a number unique to the scene and its latest change
};

// Ends a change of the scene. If `ok` is true, gives the scene a new state, by which renderers
// notice the change. Otherwise, stores *cause in *error.
bool scene_handle_changed(ClrtScene *scene, bool ok, const Error *cause, ClrtError *error);

// Fails with CLRT_ARGUMENT if the scene has no material with this number.
bool scene_handle_check_material(const ClrtScene *scene, uint32_t number, ClrtError *error);

// Converts the camera to *viewpoint. Fails with CLRT_ARGUMENT if the camera is invalid.
bool scene_handle_take_camera(Viewpoint *viewpoint, const ClrtCamera *camera, ClrtError *error);

// Fails with CLRT_ARGUMENT if the scene has no view with this number. Views are numbered from 1.
bool scene_handle_check_view(const ClrtScene *scene, uint32_t view, ClrtError *error);

struct ClrtRenderer {
    Session session;
    RayCaster caster;       // empty until rays are cast
    struct RayBatch *batch; // owned; NULL until rays are cast; reused to avoid page faults
    atomic_bool is_busy;    // true while a call uses the renderer
    uint64_t state; // ClrtScene::state when the session received the scene; 0 without a scene
};

// Checks the arguments and marks the renderer as busy. On success, the caller must call
// renderer_handle_end later.
bool renderer_handle_begin(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error);
void renderer_handle_end(ClrtRenderer *renderer);

// Passes the scene to the session, unless the session already has the scene in this state. Later
// calls compile the scene when they draw a picture or cast rays.
bool renderer_handle_take(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error);
