// SPDX-License-Identifier: MIT
// Scene -> an error message about triangles without area.
#pragma once

#include "base/error.h"
#include "scene/scene.h"

// Fails if the reader dropped a triangle.  The message names the file, the first offender and the
// count.
bool bad_geometry_none_dropped(const Scene *scene, Error *error);

// Fails if any triangle has no area, dropped or not.
bool bad_geometry_none(const Scene *scene, Error *error);
