// SPDX-License-Identifier: MIT
// The data that the viewer's files share. viewer.c runs the loop. viewer_follow.c handles the
// worker's results and changed files. viewer_show.c draws, prints and saves.
#pragma once

#include "base/array.h"
#include "view/status_text.h"
#include "view/viewer.h"
#include "view/views.h"
#include "view/watch.h"
#include "view/window.h"
#include "view/worker.h"

#include <stdint.h>
#include <stdio.h>

// The times between displayed frames while the camera turns automatically.
typedef struct {
    ARRAY(double) seconds; // from each frame to the next
    double latest; // clock time of the latest frame; 0 at first and after the camera has stopped
} FrameTimes;

// Prints the statistics. `frames` is the number of complete pictures of PASS_MOVING, and `coarse`
// is the number of these pictures with fewer pixels than the window.
void frame_times_write(const FrameTimes *times, uint64_t coarse, uint64_t frames, FILE *stream);
void frame_times_free(FrameTimes *times);

#define NOTICE_SIZE 512
#define STATE_SIZE  1024

typedef struct {
    // A copy of the settings of viewer_run, because the worker may outlive viewer_run. `keys`
    // points to the next key to play.
    ViewerSettings settings;
    Window window;
    Views views;
    Canvas canvas;
    Worker *worker;
    WorkerRequest request;
    WorkerStatus status;
    Model *model; // holds a reference; NULL until the first scene is read
    StateScene scene;
    State state;
    ARRAY(char *) dropped; // owned paths of dropped files; the worker may still read these strings
    Watch scene_files, kernel_files;
    double polled;            // time of the latest check of the watched files
    bool is_failure_followed; // the scene's folder is watched too, because the latest read failed
    bool wants_save;
    FrameTimes frame_times;
    uint64_t explained;    // request.explains of the displayed explanation; 0 for none
    double hint_end;       // time at which the help hint disappears; 0 without a hint
    double advanced;       // time up to which the camera has turned automatically
    double moved;          // time of the latest camera motion; 0 once the camera rests
    uint64_t moving_shown; // status.moving_frames at the latest displayed frame
    Error failure;         // failure of the window's own operations
    char notice[NOTICE_SIZE];
    char printed_state[STATE_SIZE], printed_failure[STATE_SIZE]; // the texts that were printed last
    char title[STATE_SIZE];                                      // the window's current title
    bool is_dirty, quits;
} Viewer;

// Processes the worker's status. Returns false if the window fails or memory runs out.
bool viewer_follow_worker(Viewer *viewer, Error *error);

// Switches to the worker's latest model.
bool viewer_adopt_model(Viewer *viewer, Error *error);

// Watches the scene's path and, if there is a model, the model's files. If the latest read failed,
// also watches the path's folder, because a file may be missing.
bool viewer_watch_files(Viewer *viewer, Error *error);

// Switches to a file that was dropped on the window, if any.
bool viewer_take_drop(Viewer *viewer, Error *error);

// Requests a new read of changed scene files, and a new build of changed kernels.
void viewer_follow_files(Viewer *viewer);

// If the driver has lost the OpenGL context, reopens the window and rebuilds its contents.
bool viewer_recover(Viewer *viewer, Error *error);

// Returns whether the effects of all keys played so far are complete.
bool viewer_is_settled(const Viewer *viewer);

bool viewer_draw(Viewer *viewer, Error *error);

// Saves the picture if a save is requested and the picture is complete.
void viewer_save(Viewer *viewer);
