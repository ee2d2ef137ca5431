// SPDX-License-Identifier: MIT
// The parts of accel that clients use: they show and examine triangles and trees, and cast rays.
#pragma once

#include "accel/flat.h"
