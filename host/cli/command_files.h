// SPDX-License-Identifier: MIT
// The command line, and the scene once it is read -> the files of the run.
#pragma once

#include "base/file_plan.h"
#include "cli/options/options.h"
#include "scene/scene.h"

// Adds every file that the options name, and the files of scene unless it is NULL.
bool command_files_add(FilePlan *plan, const Options *options, const Scene *scene, Error *error);

// Fails if an output would replace an input or another output.  Programs call it twice: before any
// work, and again once the scene names its meshes.
bool command_files_check(const Options *options, const Scene *scene, Error *error);
