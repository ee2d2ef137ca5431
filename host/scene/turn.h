// SPDX-License-Identifier: MIT
// A camera on a turntable.
#pragma once

#include "scene/scene.h"

// Returns the viewpoint with its eye turned by degrees about up: around the point it looks at or,
// for the course's viewpoints, around the origin. At 0 the bits are unchanged.
Viewpoint turn_viewpoint(const Viewpoint *viewpoint, bool is_course, double degrees);
