// SPDX-License-Identifier: MIT
// A worker thread reads scenes and traces pictures, so the window never waits. The window posts
// requests and polls the status. The two threads share only the request, the status, the canvas and
// published models.
//
// A request is not a queue of commands. It describes the whole picture that the window needs now.
// The worker compares the request with its finished work, and chooses the next job from the
// difference. A later request replaces an earlier one, so the worker does not lag behind a fast
// mouse. After each finished tile, the worker checks the request again, and stops a pass that is no
// longer needed.
//
// Some work leaves no difference to compare, for example reading a changed file again. The request
// counts such work in members like `loads`, and the status has the same members for finished work.
// Equal counters mean that the work is done.
//
// Invariant: one mutex guards request, status and model, and no thread holds it during long work.
#pragma once

#include "session/session.h"
#include "view/draw/canvas.h"
#include "view/model.h"
#include "view/plan.h"

typedef struct {
    const char *path; // path of the scene; the string outlives the worker
    SceneLoadOptions load;
    bool is_traced;   // the ray-traced view is displayed
    uint64_t subject; // from 1; increases with every new scene, camera or size
    Viewpoint camera;
    uint32_t width, height;
    uint32_t samples; // along each side of a pixel
    bool uses_bvh;
    double gain;
    uint64_t loads;    // number of requested scene reads, including the first
    uint64_t renewals; // number of requested kernel builds after the first
    uint64_t explains; // number of requested explanations
    uint32_t pixel[2]; // the pixel to explain
} WorkerRequest;

typedef enum { FAULT_NONE, FAULT_SCENE, FAULT_DEVICE } WorkerFault;

#define EXPLANATION_SIZE 4096

typedef struct {
    uint64_t number;     // number of status updates
    WorkerFault fault;   // a fault after which nothing can be displayed
    Error scene_failure; // failure to read the scene; empty if reading succeeded
    Error failure;       // failure of the device or the kernels
    uint64_t models;     // number of published models
    bool has_tree;       // the latest model's tree is built
    const char *busy;    // the current operation; empty while tracing or idle
    WorkerRequest done;  // finished loads, renewals and explains; uses_bvh, camera and gain of the
                         // latest picture
    PlanReached reached;
    double progress;                    // finished fraction of the current pass
    double frame_seconds;               // tracing time of the latest complete picture
    uint64_t moving_frames;             // number of complete pictures of PASS_MOVING
    uint64_t moving_coarse;             // number of moving_frames at reduced resolution
    uint64_t tallies[TALLY_KINDS];      // valid if reached.is_counted
    char explanation[EXPLANATION_SIZE]; // of the latest pixel, or an error message
} WorkerStatus;

typedef struct Worker Worker;

// The inputs of a worker. The canvas must outlive the worker.
typedef struct {
    SessionSettings session;
    Cache cache;
    int32_t max_level; // as ClrtPicture::max_level
    Canvas *canvas;
    void (*wake)(void); // called by the worker after every status update
} WorkerSetup;

// Starts the worker with a first request. Returns NULL on failure.
Worker *worker_start(const WorkerSetup *setup, const WorkerRequest *request, Error *error);

void worker_request(Worker *worker, const WorkerRequest *request);
void worker_poll(Worker *worker, WorkerStatus *status);

// Returns the latest model with a reference that the caller releases. Returns NULL if there is no
// model yet.
Model *worker_model(Worker *worker);

// Returns whether all work for the request is finished, except for PASS_COUNT.
bool worker_is_finished(const WorkerStatus *status, const WorkerRequest *request);

// Stops and frees the worker. If the worker does not stop within `seconds` seconds, worker_stop
// frees nothing and returns false. The process must then end.
bool worker_stop(Worker *worker, double seconds);
