// SPDX-License-Identifier: MIT
// The state of a whole run, and the stages that commands share. Each stage borrows the results of
// earlier stages. run_free accepts a Run after any stage, even a zeroed one, so that errors need
// one cleanup path.
#pragma once

#include "accel/flat.h"
#include "cli/options/options.h"
#include "cli/process.h"
#include "cli/report.h"
#include "mesh/ply.h"

#include <pthread.h>

// Opens the device and makes the kernel on a background thread, while the caller reads the scene
// and builds its tree.

// Once the device is open, the caller may use the members up to is_quick, except setup.ready.
typedef struct {
    RendererSetup setup;
    Device device;
    double device_seconds;
    uint32_t group[2]; // the sides of work-groups
    bool is_quick;     // async_device_choose has selected kernels that compile faster
    // Internal members:
    const Options *options;
    ReadyKernel ready;
    Error error;
    pthread_t thread;
    pthread_mutex_t mutex; // guards is_done, is_open, is_decided and is_wanted
    pthread_cond_t changed;
    bool is_done, is_open;      // opening the device has finished; it succeeded
    bool is_decided, is_wanted; // the caller has decided about the kernel; the decision
    bool is_running, exists;    // the thread runs; the mutex and the condition exist
} AsyncDevice;

// Starts the thread. The caller must set the cache and the kernels' source in setup.
void async_device_begin(AsyncDevice *async, const Options *options, RendererSetup setup);

// Decides whether the thread makes the kernel. Before the decision, the thread makes it only if the
// cache holds it. Only the first call has an effect.
void async_device_decide(AsyncDevice *async, bool wanted);

// Waits for the device. Returns false with the reason if the device cannot be opened.
bool async_device_wait_device(AsyncDevice *async, Error *error);

// Selects faster-compiling kernels if they save time and the options allow them. Call it after
// async_device_wait_device and before async_device_decide(async, true). It has no effect if the
// cache holds the kernels chosen first.
void async_device_choose(AsyncDevice *async, const RenderSettings *settings, uint64_t triangles);

// Waits until setup.ready holds the kernel. If making the kernel failed, setup.ready is empty, and
// the renderer will report the reason.
void async_device_wait_kernel(AsyncDevice *async);

// Waits for the thread, closes the device and frees all resources.
void async_device_free(AsyncDevice *async);

typedef struct {
    const Options *options;
    Cache cache;
    Scene scene;
    Normalization normalization;
    FlatScene flat;
    AsyncDevice async_device;
    RenderSettings settings;
    Renderer renderer;
    Report report;
} Run;

// Returns the seconds since *moment, and sets *moment to the current time.
double run_lap(double *moment);

// Starts a thread that opens the device and makes the kernel.
void run_begin(Run *run);

// Reads the scene, and computes its normalized coordinate frame and the picture's settings. On
// failure, it cancels the making of the kernel.
bool run_load_scene(Run *run, Error *error);

// Calls run_begin and run_load_scene, and checks the scene's files against the outputs. Returns the
// exit status.
ExitCode run_start(Run *run, Error *error);

// Waits for the device and chooses the kernels for device and scene. The kernels determine the
// layout of nodes.
bool run_await_device(Run *run, Error *error);

// Builds the tree and flattens the scene into arrays.
bool run_build_scene(Run *run, Error *error);

// Calls run_await_device and run_build_scene, and opens the renderer. Returns the exit status.
ExitCode run_prepare(Run *run, Error *error);

// Frees the results of all stages.
void run_free(Run *run);

// Reads the scene on the command line, a file or standard input, with the contract of scn_load.
bool scene_source_load(Scene *scene, const Options *options, PlyParse *parse, Error *error);
