// SPDX-License-Identifier: MIT
// clrt convert: a scene or mesh, written as scene text with binary PLY meshes, or as one PLY mesh.
#pragma once

#include "cli/exit_code.h"
#include "cli/options.h"

// Whether it writes files with the ending of that path.
bool convert_takes(const char *path, Error *error);

ExitCode convert_scene(const Options *options, Error *error);
