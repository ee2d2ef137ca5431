// SPDX-License-Identifier: MIT
// The scene that the command line names -> Scene: a file, or standard input.
#pragma once

#include "cli/options/options.h"
#include "mesh/ply.h"
#include "scene/scene.h"

// As scn_load does.
bool scene_source_load(Scene *scene, const Options *options, PlyParse *parse, Error *error);
