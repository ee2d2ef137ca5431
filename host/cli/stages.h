// SPDX-License-Identifier: MIT
// The stages from the command line to a session that is ready to draw. Commands call the stages
// that they need, in the order of this file.
#pragma once

#include "cli/options/options.h"
#include "session/picture.h"

typedef struct {
    double parse, load, build; // of the scene's text, of its meshes, of the tree and arrays
} StageSeconds;

// Returns the seconds since *moment, and sets *moment to the current time.
double stage_lap(double *moment);

// Prints a note on standard error, without control characters, unless --quiet is given.
__attribute__((format(printf, 2, 3))) void stage_note(const Options *options, const char *format,
                                                      ...);

// Returns the session settings that the options describe.
SessionSettings stage_settings(const Options *options);

// Sets the session's settings, and starts a thread that opens the device.
void stage_begin(Session *session, const Options *options);

// Reads the scene as scn_load does, from the file that the options name or from standard input.
bool stage_read(Scene *scene, const Options *options, Error *error);

// Reads and checks the scene, and passes it to the session.
bool stage_load(Session *session, Scene *scene, const Options *options, StageSeconds *seconds,
                Error *error);

// Calls stage_begin and stage_load. Fails if an output would replace a file of the scene.
ExitCode stage_start(Session *session, Scene *scene, const Options *options, StageSeconds *seconds,
                     Error *error);

// Fills *request from the options and the scene.
bool stage_request(SessionPicture *request, const Options *options, const Scene *scene,
                   Error *error);

// Returns the session's scene for the kernels of pictures, or NULL on failure. The first call
// builds the tree and the scene's arrays.
const SceneForm *stage_build(Session *session, const Options *options, Error *error);

// Waits for the device, chooses the kernels for the device, the scene and the work, and calls
// stage_build. Adds the time of stage_build to seconds->build. `work` may be NULL.
ExitCode stage_prepare(Session *session, const Options *options, const SessionWork *work,
                       StageSeconds *seconds, Error *error);
