// SPDX-License-Identifier: MIT
// The viewer's own value, which its files share: viewer.c is the loop, viewer_follow.c takes in
// what the worker and the file system did, viewer_show.c draws, tells and saves.
#pragma once

#include "view/frame_times.h"
#include "view/reload.h"
#include "view/saver.h"
#include "view/script.h"
#include "view/status_text.h"
#include "view/viewer.h"
#include "view/views.h"
#include "view/window.h"
#include "view/worker.h"

#define STATE_SIZE 1024

typedef struct {
    ViewerSettings settings; // copies, with the cache: the worker may outlive the call
    Cache cache;
    Window window;
    Views views;
    Canvas canvas;
    Worker *worker;
    WorkerRequest request;
    WorkerStatus status;
    Model *model; // held; NULL until the first is read
    StateScene scene;
    State state;
    ARRAY(char *) dropped; // paths, owned: the worker may be reading any of them
    Reload reload;
    bool is_failure_followed; // the scene's failure, by the files watched
    Script script;
    Saver saver;
    bool wants_save;
    FrameTimes frame_times;
    double advanced;       // moment until which the camera has turned by itself
    uint64_t moving_shown; // pictures of a moving camera that were traced when one was shown
    Error failure;         // of the window's own doings
    char notice[SAVER_TEXT_SIZE];
    char told[STATE_SIZE], title[STATE_SIZE]; // the latest state told, and the window's title
    char told_failure[STATE_SIZE];
    bool is_dirty, quits;
} Viewer;

// Takes in what the worker has done; false where nothing can be shown any more.
bool viewer_follow_worker(Viewer *viewer, Error *error);

// Shows the latest model that was read.
bool viewer_adopt_model(Viewer *viewer, Error *error);

// Goes on with a file that was dropped on the window.
bool viewer_take_drop(Viewer *viewer, Error *error);

// Wishes for files that have changed to be read again.
void viewer_follow_files(Viewer *viewer);

// Reads and makes everything again, also what OpenGL keeps.
bool viewer_renew(Viewer *viewer, Error *error);

// Makes the window again where the driver has lost its context, with everything in it.
bool viewer_recover(Viewer *viewer, Error *error);

// Whether nothing is under way any more that the keys played so far have caused.
bool viewer_is_settled(const Viewer *viewer);

// Draws the window's picture and text.
bool viewer_draw(Viewer *viewer, Error *error);

// Saves what was drawn last, if that is wished, once it is all there; and tells of it once it is
// written.
void viewer_save(Viewer *viewer);
void viewer_follow_saver(Viewer *viewer);
