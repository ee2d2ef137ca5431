// SPDX-License-Identifier: MIT
// clrt convert: a scene or mesh, written as scene text with binary PLY meshes, or as one PLY mesh.
#pragma once

#include "cli/exit_code.h"
#include "cli/options/options.h"

ExitCode convert_scene(const Options *options, Error *error);
