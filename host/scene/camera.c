// SPDX-License-Identifier: MIT
// Computes the camera's axes in fp64 and rounds each component to float once.
#include "scene/camera.h"

#include "base/trigonometry.h"

static void store(float out[4], Vec3 v)
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
    out[3] = 0;
}

CameraData camera_make(const Viewpoint *viewpoint, const Normalization *normalization,
                       uint32_t height, uint32_t samples)
{
    const Vec3 forward = vec3_normalize(vec3_sub(viewpoint->look_at, viewpoint->eye));
    const Vec3 right = vec3_normalize(vec3_cross(forward, vec3_normalize(viewpoint->up)));
    const Vec3 down = vec3_cross(forward, right);
    const double half = viewpoint->fov_degrees / 2;
    const double half_height = sine_of_degrees(half) / cosine_of_degrees(half);
    // Sample coordinates count half steps from the picture's center. Both axes have the same step,
    // because pixels are square.
    const double half_step = half_height / ((double)height * samples);
    CameraData camera;
    store(camera.eye, normalize_point(normalization, viewpoint->eye));
    store(camera.forward, forward);
    store(camera.right_step, vec3_scale(right, half_step));
    store(camera.down_step, vec3_scale(down, half_step));
    return camera;
}

void camera_shift(CameraData *camera, double right, double down)
{
    for (int axis = 0; axis < 3; axis++) {
        const double step =
            right * (double)camera->right_step[axis] + down * (double)camera->down_step[axis];
        camera->forward[axis] = (float)((double)camera->forward[axis] + 2 * step);
    }
}
