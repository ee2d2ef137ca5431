// SPDX-License-Identifier: MIT
// Moves a scene into the normalized frame and rounds its numbers as the host does for a device.
// Spheres become sums of two floats, and all other numbers become floats. The oracle then traces
// the same numbers as the kernels.
#pragma once

#include "oracle/oracle.h"
#include "scene/normalize.h"

// Moves and rounds the scene, except cameras. Checkers move too; all other numbers of materials are
// floats already.
bool stored_round(Scene *scene, const Normalization *normalization, Error *error);

// Returns the oracle's view of a picture. The camera must be made for the picture's size, with one
// sample per pixel.
OracleView stored_view(const Oracle *oracle, const CameraData *camera, uint32_t width,
                       uint32_t height);
