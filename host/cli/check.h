// SPDX-License-Identifier: MIT
// clrt check: a scene's geometry is judged without drawing it.
#pragma once

#include "cli/exit_code.h"
#include "cli/options/options.h"
#include "device/cache.h"
#include "scene/scene.h"

// Writes the report as the options say.  A device is missed only where the options name one.
ExitCode check_scene(const Options *options, const Cache *cache, Error *error);

// For pictures: refuses a scene with triangles of no area where the options say so, and tells of
// those left out where they do not.
bool check_geometry(const Options *options, const Scene *scene, Error *error);
