// SPDX-License-Identifier: MIT
// Viewpoint -> CameraData: the origin of a picture's rays and the steps between their directions,
// in normalized coordinates. The file also turns viewpoints as on a turntable.
#pragma once

#include "scene/normalize.h"
#include "scene/scene.h"

// Returns the course's pinhole camera. Its image plane has distance 1 and height 2 tan(fov / 2). In
// a narrow picture, the plane is larger, so that it spans width_degrees. Pixels are square. samples
// is the number of sub-pixels per pixel and axis.
CameraData camera_make(const Viewpoint *viewpoint, const Normalization *normalization,
                       uint32_t width, uint32_t height, uint32_t samples);

// Moves all samples to the right and down, in units of the distance between neighboring samples.
void camera_shift(CameraData *camera, double right, double down);

// Returns the viewpoint with its eye rotated about an axis parallel to up. The axis passes through
// look_at or, for the course's viewpoints, through the origin. 0 degrees change no bit.
Viewpoint turn_viewpoint(const Viewpoint *viewpoint, bool is_course, double degrees);
