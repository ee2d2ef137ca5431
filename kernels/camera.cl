// SPDX-License-Identifier: MIT
// Computes the rays of a perspective or orthographic camera. The integers x and y of its formulas
// (CameraData in shared.h) are exact in Real, and two fma compute each component, so every device
// computes the same rays.
#ifndef CLRT_CAMERA_CL
#define CLRT_CAMERA_CL
#include "ray.cl"

// Returns the ray through a position in the whole picture. `x` and `y` count half sub-pixels from
// the picture's top left corner.
static inline Ray camera_ray_toward(const FrameData *frame, UInt x, UInt y, Mask active)
{
    const Real across = to_real(to_int(x) - (int)(frame->width * frame->samples));
    const Real along = to_real(to_int(y) - (int)(frame->height * frame->samples));
    const Real3 eye = load_private3(frame->camera.eye);
    const Real3 right = load_private3(frame->camera.right_step);
    const Real3 down = load_private3(frame->camera.down_step);
    const Real3 forward = load_private3(frame->camera.forward);
    const bool orthographic = frame->camera.orthographic != 0;
    const Real3 middle = orthographic ? eye : forward;
    const Real3 moved = {fma(across, right.x, fma(along, down.x, middle.x)),
                         fma(across, right.y, fma(along, down.y, middle.y)),
                         fma(across, right.z, fma(along, down.z, middle.z))};
    return (Ray){orthographic ? moved : eye,
                 orthographic ? forward : moved,
                 NOTHING,
                 NOTHING,
                 RAY_CAMERA,
                 active};
}

// Returns the ray through the center of a sub-pixel. `sample_x` and `sample_y` count sub-pixels of
// the whole picture.
static inline Ray camera_ray(const FrameData *frame, UInt sample_x, UInt sample_y, Mask active)
{
    return camera_ray_toward(frame, 2 * sample_x + 1, 2 * sample_y + 1, active);
}

#endif
