// SPDX-License-Identifier: MIT
// The state of a run, and its first stages, which all commands share.  Each stage borrows the
// earlier ones' values and fills its own.  A zeroed Run is valid and freeing it is harmless, so
// there is one cleanup path.
#pragma once

#include "accel/flat.h"
#include "cli/async_device.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "jobs/resume.h"
#include "mesh/ply.h"
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
    Framebuffer reference;   // empty unless requested
    Layers layers;           // beside the colors
    uint32_t *samples;       // of each pixel, for the layers; NULL if all have the same number
    CertaintyMap certainty;  // empty unless requested
    const char *output_path; // of the picture being drawn
    Viewpoint viewpoint;     // of that picture
    Resume resume;           // empty without --resume
    Report report;
    int stopped_by; // a signal; 0 if the picture is complete
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
