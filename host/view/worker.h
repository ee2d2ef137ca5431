// SPDX-License-Identifier: MIT
// The thread that reads scenes and traces pictures, so that the window never waits.  The window
// says what it wishes and looks what news there are; nothing else passes between the two.
#pragma once

#include "view/draw/canvas.h"
#include "view/tracer.h"

// What the window wants.
typedef struct {
    const char *path; // of the scene; the string outlives the worker
    bool is_traced;   // the ray-traced view is shown
    uint64_t subject; // ascending, from 1: another one with every camera and size
    Viewpoint camera;
    uint32_t width, height;
    uint32_t samples; // per pixel and axis
    bool uses_bvh;
    double gain;
    uint64_t loads;    // how often the scene was to be read, the first time included
    uint64_t renewals; // how often the kernels were to be made again
} WorkerRequest;

typedef enum { FAULT_NONE, FAULT_SCENE, FAULT_DEVICE } WorkerFault;

// How things stand.
typedef struct {
    uint64_t number;     // of the news, ascending
    WorkerFault fault;   // that leaves nothing to show
    Error scene_failure; // of reading the scene, empty where it went well
    Error failure;       // of the device and the kernels
    uint64_t models;     // read so far
    bool has_tree;       // the latest model's tree is built
    const char *busy;    // with what, empty where it is tracing or idle
    WorkerRequest done;  // the wish that the latest whole picture and its scene answer
    PlanReached reached;
    double progress;                       // of the pass that is being traced
    double frame_seconds;                  // of the latest pass
    uint64_t moving_frames, moving_coarse; // pictures of moving cameras; those not of all pixels
    uint64_t tallies[TALLY_KINDS];         // where reached is counted
} WorkerStatus;

typedef struct Worker Worker;

// What a worker stands on, which outlives it.
typedef struct {
    const TracerOptions *options;
    Canvas *canvas;
    void (*wake)(void); // called whenever there are news
} WorkerSetup;

// Starts, with a first wish.  NULL with the reason where no thread can be had.
Worker *worker_start(const WorkerSetup *setup, const WorkerRequest *request, Error *error);

void worker_request(Worker *worker, const WorkerRequest *request);
void worker_poll(Worker *worker, WorkerStatus *status);

// The latest model, held for the caller; NULL while there is none.
Model *worker_model(Worker *worker);

// Whether nothing is left to read or to trace for the wish.
bool worker_is_finished(const WorkerStatus *status, const WorkerRequest *request);

// Stops and frees the worker.  Where it does not come to its end within so many seconds, nothing
// is freed and it returns false: the process is to end then.
bool worker_stop(Worker *worker, double seconds);
