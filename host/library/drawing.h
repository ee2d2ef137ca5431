// SPDX-License-Identifier: MIT
// ClrtPicture -> Drawing: a checked request that the session can draw, with the state of the call.
#pragma once

#include "library/handles.h"
#include "session/picture.h"
#include "session/request.h"

typedef struct {
    ClrtRenderer *renderer; // the caller's
    const ClrtScene *handle;
    const Scene *scene;
    ClrtPicture wanted;      // copy of the caller's request
    AovSet channels;         // the channels in `wanted`
    SessionPicture request;  // `wanted`, completed with the scene's defaults
    Framebuffer framebuffer; // borrows the caller's memory
    PictureResult drawn;
    double seconds;
    uint64_t tiles_done, tiles;
    bool is_stopped; // by the caller's progress function
} Drawing;

// Checks the arguments and marks the renderer as busy. The caller must have set the members
// `renderer` and `handle`. On success, the caller must call drawing_end later.
bool drawing_begin(Drawing *drawing, const ClrtPicture *picture, ClrtError *error);
void drawing_end(Drawing *drawing);

// Passes the scene to the session. Fails if the scene's coordinates differ too much in size, or if
// the camera is too far from the scene.
bool drawing_take_scene(Drawing *drawing, ClrtError *error);

// The RenderObserver of all passes. It calls the caller's progress function.
bool drawing_continues(void *context, const RenderProgress *progress);
