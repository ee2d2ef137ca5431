// SPDX-License-Identifier: MIT
// A scene as the device is given it: moved into the normalized frame and rounded to float, for the
// oracle to trace the very numbers that the kernels do.
#pragma once

#include "oracle/oracle.h"
#include "scene/normalize.h"

// Replaces every number of the scene by what is stored of it, but for cameras.
bool stored_round(Scene *scene, const Normalization *normalization, Error *error);

// The rays of a picture, one a pixel, through a camera made for it.
OracleView stored_view(const Oracle *oracle, const CameraData *camera, uint32_t width,
                       uint32_t height);
