// SPDX-License-Identifier: MIT
// Shows a scene file in a window, by OpenGL or by ray tracing.
#pragma once

#include "image/image_file.h"
#include "view/worker.h"

typedef struct {
    const char *scene_path;
    SceneLoadOptions load;
    uint32_t view;          // number of the viewpoint, from 1
    uint32_t width, height; // 0: the scene's
    uint32_t samples;       // along each side of a pixel, in anti-aliased pictures
    bool smooth, uses_bvh;  // initial values; smooth: resting pictures are anti-aliased
    Encoding encoding;
    int exposure;       // initial, in half stops
    WorkerSetup worker; // viewer_run sets canvas and wake
    const char *keys;   // keys to play, starting in the OpenGL view; NULL for none
    bool statistics;    // print frame times at the end
    bool verbose;       // print the state whenever it changes
    double patience;    // seconds to wait for the worker thread at the end
} ViewerSettings;

typedef enum { VIEWER_CLOSED, VIEWER_NO_WINDOW, VIEWER_NO_SCENE, VIEWER_NO_DEVICE } ViewerEnd;

// Shows the scene until the window is closed or a failure occurs. *is_stopped receives false if the
// worker thread still runs. The process must then end, and must not remove PoCL's private folder.
ViewerEnd viewer_run(const ViewerSettings *settings, bool *is_stopped, Error *error);
