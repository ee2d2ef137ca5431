// SPDX-License-Identifier: MIT
// A scene's triangles and tree on the host, for clients that show or examine them.
#pragma once

#include "accel/flat.h"

// A ray in the device's layout. The fourth components are zero.
typedef struct {
    float origin[4];
    float direction[4];
} CastRay;
