// SPDX-License-Identifier: MIT
// Sine and cosine are clrt's own, so the eye has the same bits on every machine.
#include "scene/turn.h"

#include "base/trigonometry.h"

Viewpoint turn_viewpoint(const Viewpoint *viewpoint, bool is_course, double degrees)
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
