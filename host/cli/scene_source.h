// SPDX-License-Identifier: MIT
// The scene on the command line, a file or standard input -> Scene.
#pragma once

#include "cli/options/options.h"
#include "mesh/ply.h"
#include "scene/scene.h"

// Has the contract of scn_load.
bool scene_source_load(Scene *scene, const Options *options, PlyParse *parse, Error *error);
