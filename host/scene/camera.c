// SPDX-License-Identifier: MIT
// Computes the camera's axes in fp64 and rounds each component to float once. All rays then follow
// from these floats, so the kernels compute the same directions on every device.
#include "scene/camera.h"

static void store(float out[4], Vec3 v)
{
    vec3_store(out, v);
    out[3] = 0;
}

static double tangent_of_half(double degrees)
{
    return sine_of_degrees(degrees / 2) / cosine_of_degrees(degrees / 2);
}

// Returns half the height of the image plane. A pinhole camera's plane is at distance 1, and an
// orthographic height is in normalized units.
static double half_height_of(const Viewpoint *viewpoint, double scale, uint32_t width,
                             uint32_t height)
{
    if (viewpoint->height > 0)
        return fmax(viewpoint->height, viewpoint->width * height / width) / 2 * scale;
    return fmax(tangent_of_half(viewpoint->fov_degrees),
                tangent_of_half(viewpoint->width_degrees) * height / width);
}

CameraData camera_make(const Viewpoint *viewpoint, const Normalization *normalization,
                       uint32_t width, uint32_t height, uint32_t samples)
{
    const Vec3 forward = vec3_normalize(vec3_sub(viewpoint->look_at, viewpoint->eye));
    const Vec3 right = vec3_normalize(vec3_cross(forward, vec3_normalize(viewpoint->up)));
    const Vec3 down = vec3_cross(forward, right);
    const double half_height = half_height_of(viewpoint, normalization->scale, width, height);
    // The kernels count positions in half sub-pixels from the picture's center. Sub-pixels are
    // square, so both axes have the same step.
    const double half_step = half_height / ((double)height * samples);
    CameraData camera = {.orthographic = viewpoint->height > 0};
    vec3_store(camera.eye, normalize_point(normalization, viewpoint->eye));
    store(camera.forward, forward);
    store(camera.right_step, vec3_scale(right, half_step));
    store(camera.down_step, vec3_scale(down, half_step));
    return camera;
}

void camera_shift(CameraData *camera, double right, double down)
{
    float *middle = camera->orthographic != 0 ? camera->eye : camera->forward;
    for (int axis = 0; axis < 3; axis++) {
        const double step =
            right * (double)camera->right_step[axis] + down * (double)camera->down_step[axis];
        middle[axis] = (float)((double)middle[axis] + 2 * step);
    }
}

// Uses clrt's own sine and cosine, so the eye has the same bits on every machine.
Viewpoint camera_turn(const Viewpoint *viewpoint, bool is_course, double degrees)
{
    Viewpoint turned = *viewpoint;
    const Vec3 pivot = is_course ? vec3(0, 0, 0) : viewpoint->look_at;
    const Vec3 axis = vec3_normalize(viewpoint->up), arm = vec3_sub(viewpoint->eye, pivot);
    const Vec3 along = vec3_scale(axis, vec3_dot(arm, axis)), across = vec3_sub(arm, along);
    if (degrees == 0)
        return turned;
    const Vec3 there = vec3_add(vec3_scale(across, cosine_of_degrees(degrees)),
                                vec3_scale(vec3_cross(axis, across), sine_of_degrees(degrees)));
    turned.eye = vec3_add(pivot, vec3_add(along, there));
    return turned;
}
