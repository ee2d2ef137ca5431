// SPDX-License-Identifier: MIT
// ClrtPicture -> Drawing: a checked request that the session can draw, and the drawing's state.
#pragma once

#include "library/handles.h"
#include "session/picture.h"
#include "session/request.h"

typedef struct {
    ClrtRenderer *renderer; // the caller's
    const ClrtScene *handle;
    const Scene *scene;
    ClrtPicture wanted;      // a copy of the caller's request
    AovSet channels;         // the channels of wanted
    SessionPicture request;  // wanted, completed with the scene's defaults
    Framebuffer framebuffer; // borrows the caller's memory
    PictureResult drawn;
    double seconds;
    uint64_t tiles_done, tiles;
    bool is_stopped; // by the caller's progress function
} Drawing;

// Checks the arguments and marks the renderer as busy. The caller has set renderer and handle. On
// success, the caller must call drawing_end later.
bool drawing_begin(Drawing *drawing, const ClrtPicture *picture, ClrtError *error);
void drawing_end(Drawing *drawing);

// Gives the session the scene. Fails if the scene's coordinates differ too much in size, or if the
// camera is too far away.
bool drawing_take_scene(Drawing *drawing, ClrtError *error);

// The observer of all passes. It calls the caller's progress function.
bool drawing_continues(void *context, const RenderProgress *progress);
