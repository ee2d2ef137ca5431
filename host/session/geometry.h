// SPDX-License-Identifier: MIT
// The headers of accel that the session's clients may use. The window shows triangles and trees,
// and `clrt check` examines triangles.
#pragma once

#include "accel/scene_compile.h"
