// SPDX-License-Identifier: MIT
// The state of a whole run, and the stages that commands share. Each stage borrows the results of
// earlier stages. run_free accepts a Run after any stage, and also a zeroed Run, so that errors
// need one cleanup path.
#pragma once

#include "cli/options/options.h"
#include "session/picture.h"

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
    uint32_t view;     // from 1
    double turned;     // the turntable's angle in degrees
    Bvh tree;          // of the picture's kernels; only its counts
    double truncation; // bound on the color error caused by max_level
    PictureResult drawn;
    bool complete;                           // with all channels
    double parse, load, build, write, total; // seconds
    double frame_seconds[REPEAT_MAX];        // one entry per repetition
    uint32_t frame_count;
    ReferenceResult reference;
    CertaintyResult certainty;
    char pixel_hash[FRAMEBUFFER_HASH_SIZE];
} Report;

typedef struct {
    const Options *options;
    Session session;
    Scene scene;
    SessionPicture request; // for the view that the options name
    const SceneForm *form;  // the scene for the picture's kernels, after run_build_scene
    Report report;
} Run;

// Returns the seconds since *moment, and sets *moment to the current time.
double run_lap(double *moment);

SessionSettings run_session_settings(const Options *options);

// Sets the session's settings, and starts a thread that opens the device.
void run_begin(Session *session, const Options *options);

// Reads the scene, and computes the picture's settings.
bool run_load_scene(Run *run, Error *error);

// Calls run_begin and run_load_scene, and checks the scene's files against the outputs. Returns the
// exit status.
ExitCode run_start(Run *run, Error *error);

// Waits for the device and chooses the kernels for device and scene. The kernels determine the
// layout of nodes.
bool run_await_device(Run *run, Error *error);

// Builds the tree and flattens the scene into arrays.
bool run_build_scene(Run *run, Error *error);

// Calls run_await_device and run_build_scene. Returns the exit status.
ExitCode run_prepare(Run *run, Error *error);

// Frees the results of all stages. Without CLRT_TIDY_EXIT, leaves the session to the operating
// system, because drivers are slow to close.
void run_free(Run *run);

// Reads the scene that the options name, a file or standard input, as scn_load does.
bool scene_source_load(Scene *scene, const Options *options, Error *error);
