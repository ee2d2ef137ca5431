// SPDX-License-Identifier: MIT
// Scene -> a sentence about triangles of no area, for those who want to know or to refuse them.
#pragma once

#include "base/error.h"
#include "scene/scene.h"

// False, with the file, the first offender and their number, where the reader left a triangle out.
bool bad_geometry_none_dropped(const Scene *scene, Error *error);

// The same where any triangle has no area, left out or not.
bool bad_geometry_none(const Scene *scene, Error *error);
