// SPDX-License-Identifier: MIT
// A camera on a turntable.
#pragma once

#include "scene/scene.h"

// The viewpoint once its eye has turned so many degrees about up: about the point it looks at, or,
// for the course's, about the origin.  At 0 it is the same bits.
Viewpoint turn_viewpoint(const Viewpoint *viewpoint, bool is_course, double degrees);
