// SPDX-License-Identifier: MIT
// A thread that reads scenes and traces pictures, so that the window never waits.  The window posts
// requests and polls the status.  Besides, the two threads share only the canvas and finished
// models.
#pragma once

#include "view/draw/canvas.h"
#include "view/tracer.h"

// A request from the window to the worker thread.
typedef struct {
    const char *path; // of the scene; the string outlives the worker
    bool is_traced;   // the ray-traced view is displayed
    uint64_t subject; // from 1; increases with every new camera or size
    Viewpoint camera;
    uint32_t width, height;
    uint32_t samples; // per pixel and axis
    bool uses_bvh;
    double gain;
    uint64_t loads;    // number of requested scene reads, including the first
    uint64_t renewals; // number of requested kernel builds after the first
} WorkerRequest;

typedef enum { FAULT_NONE, FAULT_SCENE, FAULT_DEVICE } WorkerFault;

// The worker's status.
typedef struct {
    uint64_t number;     // of status updates
    WorkerFault fault;   // a fault after which nothing can be displayed
    Error scene_failure; // from reading the scene; empty if it succeeded
    Error failure;       // of the device and the kernels
    uint64_t models;     // number of models read
    bool has_tree;       // the latest model's tree is built
    const char *busy;    // the current operation; empty while tracing or idle
    WorkerRequest done;  // the request fulfilled by the latest complete picture and its scene
    PlanReached reached;
    double progress;               // of the current pass
    double frame_seconds;          // of the latest pass
    uint64_t moving_frames;        // pictures of moving cameras
    uint64_t moving_coarse;        // of these, at reduced resolution
    uint64_t tallies[TALLY_KINDS]; // valid if reached is counted
} WorkerStatus;

typedef struct Worker Worker;

// The inputs of a worker, which must outlive it.
typedef struct {
    const TracerOptions *options;
    Canvas *canvas;
    void (*wake)(void); // called after every status update
} WorkerSetup;

// Starts the worker with a first request.  Returns NULL with the reason if it cannot start a
// thread.
Worker *worker_start(const WorkerSetup *setup, const WorkerRequest *request, Error *error);

void worker_request(Worker *worker, const WorkerRequest *request);
void worker_poll(Worker *worker, WorkerStatus *status);

// Returns the latest model with a reference for the caller; NULL for none.
Model *worker_model(Worker *worker);

// Returns whether the request is fulfilled: nothing is left to read or trace.
bool worker_is_finished(const WorkerStatus *status, const WorkerRequest *request);

// Stops and frees the worker.  If it does not stop within that many seconds, the function frees
// nothing and returns false, and the process must then end.
bool worker_stop(Worker *worker, double seconds);
