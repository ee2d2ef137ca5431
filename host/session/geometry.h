// SPDX-License-Identifier: MIT
// The parts of accel that clients use: they show and examine triangles and trees, and cast rays.
#pragma once

#include "accel/flat.h"

// A ray in the device's layout. The fourth components are zero.
typedef struct {
    float origin[4];
    float direction[4];
} CastRay;
