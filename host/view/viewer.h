// SPDX-License-Identifier: MIT
// A scene file in a window: OpenGL and traced pictures of it, until the user closes it.
#pragma once

#include "image/image_file.h"
#include "view/tracer.h"

typedef struct {
    const char *scene_path;
    uint32_t view;          // from 1
    uint32_t width, height; // 0: the scene's
    uint32_t samples;       // per pixel and axis, of anti-aliased pictures
    bool smooth, uses_bvh;  // to begin with
    Encoding encoding;
    TracerOptions tracer;
    const char *keys;    // to play, NULL for none
    uint32_t quit_after; // frames; 0: when the user quits
    bool statistics;     // the times of frames are told in the end
    bool verbose;        // so is the state, whenever it changes
    double patience;     // seconds to wait for the device in the end
} ViewerSettings;

typedef enum { VIEWER_CLOSED, VIEWER_NO_WINDOW, VIEWER_NO_SCENE, VIEWER_NO_DEVICE } ViewerEnd;

// Shows the scene; returns when the window is closed, or cannot be opened.
ViewerEnd viewer_run(const ViewerSettings *settings, Error *error);
