// SPDX-License-Identifier: MIT
// The state of a whole run, and the stages that commands share. Each stage borrows the results of
// earlier stages. run_free accepts a Run after any stage, even a zeroed one, so that errors need
// one cleanup path.
#pragma once

#include "accel/flat.h"
#include "cli/async_device.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "mesh/ply.h"

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
