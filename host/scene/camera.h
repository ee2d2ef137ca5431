// SPDX-License-Identifier: MIT
// Viewpoint -> CameraData, which defines a picture's rays in normalized coordinates. The file also
// turns viewpoints for --turntable.
#pragma once

#include "scene/normalize.h"
#include "scene/scene.h"

// Returns a pinhole or an orthographic camera with square pixels. The pinhole camera's image plane
// has distance 1 from the eye and height 2 tan(fov / 2). In a narrow picture, the plane is enlarged
// to span the viewpoint's least width. `samples` is the number of sub-pixels per pixel and axis.
CameraData camera_make(const Viewpoint *viewpoint, const Normalization *normalization,
                       uint32_t width, uint32_t height, uint32_t samples);

// Returns how many times smaller the camera shows an object at `depth` than at depth 1.
static inline double camera_reduction(const CameraData *camera, double depth)
{
    return camera->orthographic != 0 ? 1 : depth;
}

// Moves all samples by `right` and `down`, in units of the distance between neighboring samples.
void camera_shift(CameraData *camera, double right, double down);

// Returns the viewpoint with its eye rotated about an axis parallel to viewpoint->up. The axis
// passes through viewpoint->look_at or, if `is_course`, through the origin. `is_course` is for the
// six default views (docs/scenes.md). A turn by 0 degrees changes no bit.
Viewpoint camera_turn(const Viewpoint *viewpoint, bool is_course, double degrees);
