// SPDX-License-Identifier: MIT
// The commands of clrt. Each command returns the exit status, and fills *error unless it returns
// EXIT_DONE. If check and compare return EXIT_FAULTS, *error is empty, because the reports contain
// the reason.
#pragma once

#include "base/file_plan.h"
#include "cli/options/options.h"
#include "session/session.h"

#include <stdio.h>

// A command that traces. If the command reads a scene, it stores the scene in *scene. The caller
// opens the session's cache before the call, and frees the scene after the call.
typedef ExitCode TracingCommand(const Options *options, Session *session, Scene *scene,
                                Error *error);

// clrt SCENE -o FILE: renders the scene to a picture file.
TracingCommand picture_make;

// clrt SCENE: shows the scene in a window until the user closes it.
TracingCommand show_scene;

// Prints the window's keys for the man page. In a build without a window, prints nothing.
void show_write_keys(FILE *stream);

// clrt warm: compiles kernels in advance.
TracingCommand warm_kernels;

// clrt explain SCENE: prints which kernel features and buffers a scene uses or omits, and why.
TracingCommand explain_scene;

// clrt explain SCENE X,Y: prints how clrt computes a pixel's color.
TracingCommand explain_pixel;

// clrt check: reports faults of a scene's geometry. Without a working device, the report omits the
// leaks. If the options name a device or fp64, a missing or failing device is an error.
TracingCommand check_scene;

// clrt devices: lists the OpenCL devices like `clinfo -l`, as versioned JSON, or in both forms.
ExitCode devices_print(const Options *options, Error *error);

// Checks the scene's geometry for pictures and for the commands explain, warm and convert. With
// `--bad-geometry fail`, fails if any triangle has no area. Otherwise, prints the scene's notes and
// names the first dropped triangle, unless --quiet is given.
bool check_geometry(const Options *options, const Scene *scene, Error *error);

// clrt compare: reports the differences of two pictures. If the options name an output, also draws
// a map of the differences.
ExitCode compare_files(const Options *options, Error *error);

// clrt merge: joins the parts of a picture.
ExitCode merge_parts(const Options *options, Error *error);

// clrt convert: writes a scene or mesh as scene text with binary PLY meshes, or as one PLY mesh.
ExitCode convert_scene(const Options *options, Error *error);

// The next two functions concern the files that the options name and, if `scene` is not NULL, the
// scene's files.

// Adds the files to *plan.
bool command_files_add(FilePlan *plan, const Options *options, const Scene *scene, Error *error);

// Fails if an output would replace an input or another output. main calls this function before any
// work. stage_start and check_scene call it again when the scene's files are known.
bool command_files_check(const Options *options, const Scene *scene, Error *error);

// Writes the text of --help.
void options_write_help(FILE *stream);
