// SPDX-License-Identifier: MIT
// A call that traces: the caller's request, checked and completed with the scene's defaults.
#pragma once

#include "library/handles.h"
#include "session/channels.h"
#include "session/request.h"

typedef struct {
    ClrtRenderer *renderer; // the caller's
    const ClrtScene *handle;
    const Scene *scene;
    ClrtPicture wanted;      // a copy of the caller's
    AovSet channels;         // of wanted
    SessionPicture request;  // made from wanted
    Framebuffer framebuffer; // borrows the caller's memory
    CertaintyMap certainty;
    PictureResult drawn;
    double seconds;
    uint64_t tiles_done, tiles;
    bool is_stopped; // by the caller's progress function
} Drawing;

// Checks the arguments and marks the renderer as busy. The caller has set renderer and handle. On
// success, the caller calls drawing_end later.
bool drawing_begin(Drawing *drawing, const ClrtPicture *picture, ClrtError *error);
void drawing_end(Drawing *drawing);

// Compiles the scene if necessary. Fails if it cannot be drawn, or if the camera is too far away.
bool drawing_take_scene(Drawing *drawing, ClrtError *error);

// Calls the caller's progress function. The observer of all passes.
bool drawing_continues(void *context, const RenderProgress *progress);

// Returns the number of components of the channel in this row of aov_table.
uint32_t drawing_components(size_t row);
