// SPDX-License-Identifier: MIT
// What lasts for a whole run, and its first stages, which all commands share.  Each stage borrows
// the earlier ones' values and fills its own.  A zeroed Run is valid and freeing it is harmless, so
// there is one cleanup path.
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

// Returns the seconds since *moment, and sets it to now.
double run_lap(double *moment);

// Starts opening the device and making the kernels on another thread.
void run_begin(Run *run);

// Reads the scene, and computes its normalized frame and the picture's settings.  On failure no
// kernels are made.
bool run_load_scene(Run *run, Error *error);

// Waits for the device.  The device and the scene determine the kernels, which determine the
// layout.
bool run_await_device(Run *run, Error *error);

// Flattens the scene into arrays.
bool run_build_scene(Run *run, Error *error);

// Runs these two stages and makes the renderer.  Returns the exit status.
ExitCode run_prepare(Run *run, Error *error);

// Frees the values of all stages.
void run_free(Run *run);

// Reads the scene on the command line, a file or standard input, with the contract of scn_load.
bool scene_source_load(Scene *scene, const Options *options, PlyParse *parse, Error *error);
