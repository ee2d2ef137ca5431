// SPDX-License-Identifier: MIT
// What every use of the pipeline keeps, and the stages that all of them begin with.  Stages borrow
// the ones before them and fill a value of their own; a zeroed Run is valid and freeing it does
// nothing, so there is one way out.
#pragma once

#include "accel/flat.h"
#include "cli/async_device.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "jobs/resume.h"
#include "render/certifier.h"

typedef struct {
    const Options *options;
    Cache cache;
    Scene scene;
    Normalization normalization;
    FlatScene flat;
    AsyncDevice async_device;
    RenderSettings settings;
    Renderer renderer;
    Framebuffer framebuffer;
    Framebuffer reference;   // empty unless one was asked for
    Layers layers;           // beside the colors
    uint32_t *samples;       // of each pixel, for the layers; NULL where all have as many
    CertaintyMap certainty;  // empty unless it was asked for
    const char *output_path; // of the picture being drawn
    Viewpoint viewpoint;     // it is seen from
    Resume resume;           // empty without --resume
    Report report;
    int stopped_by; // a signal, 0 where the picture is whole
} Run;

// Returns the seconds since *moment, and moves it to now.
double run_lap(double *moment);

// Begins to open the device and to make the kernels, beside what follows.
void run_begin(Run *run);

// File to scene, with the frame it is traced in and the settings of its picture.  Where that fails,
// no kernels are made.
bool run_load_scene(Run *run, Error *error);

// Waits for the device; it and the scene decide about the kernels, and they about the layout.
bool run_await_device(Run *run, Error *error);

// Scene to arrays.
bool run_build_scene(Run *run, Error *error);

// These two, and then arrays and kernels to the renderer; how it went.
ExitCode run_prepare(Run *run, Error *error);

// Frees what the stages made.
void run_free(Run *run);
