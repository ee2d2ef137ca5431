// SPDX-License-Identifier: MIT
// Viewpoint -> CameraData: where the rays of a picture start and how their directions step across
// it, in the normalized frame.
#pragma once

#include "scene/normalize.h"

// The pinhole camera of the course: an image plane at distance 1, 2 tan(fov / 2) high, with square
// pixels, so that its height in pixels decides the step.  samples is the number of sub-pixels per
// pixel and axis.
CameraData camera_make(const Viewpoint *viewpoint, const Normalization *normalization,
                       uint32_t height, uint32_t samples);

// Moves all samples right and down, by parts of the distance between two.
void camera_shift(CameraData *camera, double right, double down);
