// SPDX-License-Identifier: MIT
// The scene that the command line names -> Scene: a file, or standard input.
#pragma once

#include "cli/options/options.h"
#include "scene/scene.h"

// As scn_load and scn_load_tolerantly do.
bool scene_source_load(Scene *scene, const Options *options, Error *error);
bool scene_source_load_tolerantly(Scene *scene, const Options *options, Error *error);
