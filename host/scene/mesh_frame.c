// SPDX-License-Identifier: MIT
// From an eye, the points of a mesh lie between two planes in width and two in height. The planes
// touch the mesh. Planes of a given slope fix the nearest eye, and this eye fixes the slopes of the
// other two.
#include "scene/mesh_frame.h"

#include "base/limits.h"

#define VIEWS       6
#define FOV_DEGREES 30
#define FILLED      0.8 // part of the picture's width or height
#define MOST_STEPS  32

#define DEGREES_PER_RADIAN 57.295779513082320877

// The points that two planes support, which rise from the eye along an axis of the picture.
typedef struct {
    double high, low;           // their coordinates along the axis
    double high_back, low_back; // their distances from the center toward the eye
} Support;

// Planes of a higher slope contain more points.
static Support support_of(const MeshPlace *place, Vec3 axis, Vec3 back, double slope)
{
    const Vec3 inward = vec3_scale(back, slope);
    const Vec3 high =
        vec3_sub(triangle_runs_farthest(&place->runs, vec3_add(inward, axis)), place->center);
    const Vec3 low =
        vec3_sub(triangle_runs_farthest(&place->runs, vec3_sub(inward, axis)), place->center);
    return (Support){vec3_dot(high, axis), vec3_dot(low, axis), vec3_dot(high, back),
                     vec3_dot(low, back)};
}

// Returns the distance from the center at which planes of this slope meet.
static double distance_of(const Support *support, double slope)
{
    return ((support->high - support->low) / slope + support->high_back + support->low_back) / 2;
}

// Returns the slope of the planes that meet at this distance.
static double slope_at(const Support *support, double distance)
{
    return (support->high - support->low) / (2 * distance - support->high_back - support->low_back);
}

// Returns the angle in degrees between two planes through the eye that leave a part of the picture
// free. Newton's method starts above the result, where the tangent is convex, and stays above.
static double angle_between(double slope)
{
    const double tangent = slope / FILLED;
    double half = FOV_DEGREES / 2.0;
    for (int step = 0; step < 8; step++) {
        const double sine = sine_of_degrees(half), cosine = cosine_of_degrees(half);
        half -= (sine - tangent * cosine) * cosine * DEGREES_PER_RADIAN;
    }
    return fmax(2 * half, FOV_LEAST);
}

// Shrinks the slope of planes that meet at this distance until they touch the meshes. The gap
// between planes and meshes is a convex, piecewise linear function of the slope, so Newton's method
// ends after few steps.
static double touch(const MeshPlace *place, Vec3 axis, Vec3 back, double distance, Support *support)
{
    double slope = INFINITY, next = slope_at(support, distance);
    for (int step = 0; step < MOST_STEPS && next != slope; step++) {
        slope = next;
        *support = support_of(place, axis, back, slope);
        next = slope_at(support, distance);
    }
    return next;
}

// back points from the meshes to the eye.
static Viewpoint view_from(const MeshPlace *place, Vec3 back, Vec3 up)
{
    const Vec3 right = vec3_normalize(vec3_cross(up, back));
    const Vec3 axes[2] = {right, vec3_cross(back, right)};
    const double half = FOV_DEGREES / 2.0;
    const double most = FILLED * sine_of_degrees(half) / cosine_of_degrees(half);
    // The eye is outside, even if all points are on a line to it.
    double distance = 1.01 * place->radius, slopes[2];
    Support supports[2];
    Viewpoint viewpoint = {.look_at = place->center, .up = up};
    for (int axis = 0; axis < 2; axis++) {
        supports[axis] = support_of(place, axes[axis], back, most);
        distance = fmax(distance, distance_of(&supports[axis], most));
    }
    for (int axis = 0; axis < 2; axis++) {
        Support *support = &supports[axis];
        slopes[axis] = touch(place, axes[axis], back, distance, support);
        const double middle = support->high - slopes[axis] * (distance - support->high_back);
        viewpoint.look_at = vec3_add(viewpoint.look_at, vec3_scale(axes[axis], middle));
    }
    viewpoint.eye = vec3_add(viewpoint.look_at, vec3_scale(back, distance));
    viewpoint.fov_degrees = angle_between(slopes[1]);
    viewpoint.width_degrees = angle_between(slopes[0]);
    return viewpoint;
}

bool mesh_frame_add_views(Scene *scene, const MeshPlace *place, Error *error)
{
    static const double directions[VIEWS][3] = {{3, -4.5, 2}, {0, -1, 0}, {1, 0, 0},
                                                {0, 1, 0},    {-1, 0, 0}, {0, 0, 1}};
    for (int view = 0; view < VIEWS; view++) {
        const double *d = directions[view];
        const Vec3 up = view == VIEWS - 1 ? vec3(0, 1, 0) : vec3(0, 0, 1);
        const Viewpoint viewpoint = view_from(place, vec3_normalize(vec3(d[0], d[1], d[2])), up);
        if (!array_push(&scene->viewpoints, viewpoint, error))
            return false;
    }
    return true;
}
