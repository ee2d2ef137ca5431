// SPDX-License-Identifier: MIT
// The program's commands.  Each returns the exit status and fills error unless that is EXIT_DONE.
#pragma once

#include "cli/run.h"

#include <stdio.h>

// clrt SCENE -o FILE.
ExitCode picture_make(Run *run, Error *error);

// clrt SCENE: shows the scene in a window until the user closes it.
ExitCode show_scene(const Options *options, const Cache *cache, Error *error);

// Prints the keys of the window; nothing in a build without one.
void show_write_keys(FILE *stream);

// clrt --warm: compiles kernels ahead.
ExitCode warm_kernels(Run *run, Error *error);

// clrt --explain: prints what of clrt a scene uses, what is left out, and why.
ExitCode explain_scene(Run *run, Error *error);

// clrt --explain-pixel: prints how a pixel's color comes about.
ExitCode explain_pixel(Run *run, Error *error);

// clrt --list-devices: prints the OpenCL devices as clinfo does, or as versioned JSON.
ExitCode device_report_write(bool as_json, Error *error);

// clrt check: reports on a scene's geometry.  A missing device is an error only where the options
// name one.
ExitCode check_scene(const Options *options, const Cache *cache, Error *error);

// For pictures: rejects a scene with triangles of no area where the options say so; otherwise
// prints how many are left out.
bool check_geometry(const Options *options, const Scene *scene, Error *error);

// clrt compare: reports how much two pictures differ, and writes the map of the differences where
// the options name one.
ExitCode compare_files(const Options *options, Error *error);

// clrt merge: joins the parts of a picture.
ExitCode merge_parts(const Options *options, Error *error);

// clrt convert: writes a scene or mesh as scene text with binary PLY meshes, or as one PLY mesh.
ExitCode convert_scene(const Options *options, Error *error);
