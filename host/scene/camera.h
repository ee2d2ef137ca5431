// SPDX-License-Identifier: MIT
// Converts a Viewpoint to CameraData: the origin of a picture's rays and the step of their
// directions, in the normalized frame. Also turns viewpoints, as on a turntable.
#pragma once

#include "scene/normalize.h"
#include "scene/scene.h"

// Returns the course's pinhole camera: an image plane at distance 1, 2 tan(fov / 2) high, or higher
// if the picture's width would not contain the viewpoint's width. Pixels are square. samples is the
// number of sub-pixels per pixel and axis.
CameraData camera_make(const Viewpoint *viewpoint, const Normalization *normalization,
                       uint32_t width, uint32_t height, uint32_t samples);

// Moves all samples right and down, by fractions of the distance between two.
void camera_shift(CameraData *camera, double right, double down);

// Returns the viewpoint with its eye turned by degrees about up: around the point it looks at or,
// for the course's viewpoints, around the origin. At 0 the bits are unchanged.
Viewpoint turn_viewpoint(const Viewpoint *viewpoint, bool is_course, double degrees);
