// SPDX-License-Identifier: MIT
// Moves a scene into the normalized frame and rounds it to float, like the scene that a device
// gets. The oracle then traces the same numbers as the kernels.
#pragma once

#include "oracle/oracle.h"
#include "scene/normalize.h"

// Replaces every number of the scene, except cameras, by its rounded value.
bool stored_round(Scene *scene, const Normalization *normalization, Error *error);

// Returns the rays of a picture, one per pixel. The camera must be made for the picture's size.
OracleView stored_view(const Oracle *oracle, const CameraData *camera, uint32_t width,
                       uint32_t height);
