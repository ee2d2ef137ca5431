// SPDX-License-Identifier: MIT
// The state of a whole run, and the stages that commands share. Each stage borrows the results of
// earlier stages. run_free accepts a Run after any stage, and also a zeroed Run, so that errors
// need one cleanup path.
#pragma once

#include "accel/flat.h"
#include "cli/options/options.h"

#include <pthread.h>

// The device of a run, which a background thread opens. Until run_await_device has returned true,
// other threads may use no member.
typedef struct {
    RendererSetup setup; // setup.device is `device`
    Device device;
    double device_seconds;
    bool is_quick; // the setup has kernels that compile faster than the device's usual ones
    Error error;
    pthread_t thread;
    bool is_open, is_running;
} AsyncDevice;

// The difference between a picture and its reference.
typedef struct {
    uint32_t samples; // of the reference, per pixel; 0 without a reference
    Difference difference;
    double own_error; // the reference's RMSE, estimated from its two independent halves
    double seconds;
} ReferenceResult;

// The number of pixels of each Certainty (kernels/shared.h).
typedef struct {
    uint64_t pixels[CERTAINTY_KINDS]; // zeros without --aov certainty
    double seconds;
} CertaintyResult;

// The results of a run, for reports, besides the members of Run.
typedef struct {
    uint32_t view; // from 1
    double turned; // the turntable's angle in degrees
    uint32_t bvh_nodes, bvh_leaves, bvh_depth, bvh_largest_leaf;
    uint32_t bvh_inner[BVH_MAX_DEPTH]; // inner nodes at each depth
    double estimate;   // of the RMSE, with truncation if it counts toward --error; 0 without a goal
    double bound;      // upper bound of the RMSE with 95 % confidence
    bool goal_missed;  // the goal of --error or --time
    double truncation; // bound on the color error caused by max_level
    uint64_t pixels;   // drawn by this process
    uint64_t samples;  // total of these pixels
    bool complete;
    double parse, load, build, write, total; // seconds
    double frame_seconds[REPEAT_MAX];        // one entry per repetition
    uint32_t frame_count;
    ReferenceResult reference;
    CertaintyResult certainty;
    char pixel_hash[FRAMEBUFFER_HASH_SIZE];
} Report;

typedef struct {
    const Options *options;
    Cache cache;
    Scene scene;
    Normalization normalization;
    FlatScene flat;                 // compiled for the picture's kernels
    FlatScene others[NODE_LAYOUTS]; // compiled for other kernels; see run_compiled_scene
    AsyncDevice async_device;
    RenderSettings settings;
    Renderer renderer;
    Report report;
} Run;

// Returns the seconds since *moment, and sets *moment to the current time.
double run_lap(double *moment);

// Starts a thread that opens the device.
void run_begin(Run *run);

// Reads the scene, and computes its normalized coordinate frame and the picture's settings.
bool run_load_scene(Run *run, Error *error);

// Calls run_begin and run_load_scene, and checks the scene's files against the outputs. Returns the
// exit status.
ExitCode run_start(Run *run, Error *error);

// Waits for the device and chooses the kernels for device and scene. The kernels determine the
// layout of nodes.
bool run_await_device(Run *run, Error *error);

// Waits for the thread of run_begin. Closes the device only with CLRT_TIDY_EXIT, because drivers
// are slow to close.
void run_close_device(Run *run);

// Builds the tree and flattens the scene into arrays.
bool run_build_scene(Run *run, Error *error);

// Returns the scene in a layout of nodes, with a tree also if --no-bvh is given, or NULL. The scene
// is compiled once per layout, after run_build_scene.
const FlatScene *run_compiled_scene(Run *run, NodeLayout layout, Error *error);

// Calls run_await_device and run_build_scene, and opens the renderer. Returns the exit status.
ExitCode run_prepare(Run *run, Error *error);

// Frees the results of all stages; of the renderer only the program, except with CLRT_TIDY_EXIT.
void run_free(Run *run);

// Reads the scene that the options name, a file or standard input, as scn_load does.
bool scene_source_load(Scene *scene, const Options *options, Error *error);
