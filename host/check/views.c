// SPDX-License-Identifier: MIT
// A mesh contains a point if its triangles cover more than half of all directions from there,
// counted by orientation. Solid angles: Van Oosterom and Strackee, "The Solid Angle of a Plane
// Triangle", 1983.
#include "check/views.h"

#include "scene/camera.h"

#define TAU 6.283185307179586477

// Corners must be farther out than this many half pictures, so that rounding hides no visible mesh.
#define MARGIN 1.001

static Vec3 seen_from(Vec3 eye, const Mesh *mesh, uint32_t vertex)
{
    return vec3_normalize(vec3_sub(vec3_of_doubles(mesh->positions[vertex]), eye));
}

// Returns half of the signed solid angle.
static double half_solid_angle(Vec3 a, Vec3 b, Vec3 c)
{
    return atan2(vec3_dot(a, vec3_cross(b, c)),
                 1 + vec3_dot(a, b) + vec3_dot(b, c) + vec3_dot(c, a));
}

static bool mesh_contains(const Mesh *mesh, Vec3 eye)
{
    double sum = 0;
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    mesh_add_bounds(mesh, &low, &high);
    if (eye.x < low.x || eye.y < low.y || eye.z < low.z || eye.x > high.x || eye.y > high.y ||
        eye.z > high.z)
        return false;
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
        const uint32_t *corners = mesh->triangles[triangle];
        sum += half_solid_angle(seen_from(eye, mesh, corners[0]), seen_from(eye, mesh, corners[1]),
                                seen_from(eye, mesh, corners[2]));
    }
    return fabs(sum) > TAU / 2;
}

static bool sphere_contains(const Sphere *sphere, Vec3 eye)
{
    const Vec3 apart = vec3_scale(vec3_sub(eye, sphere->center), 1 / sphere->radius);
    return vec3_dot(apart, apart) < 1;
}

// Stores the first object that contains the eye. Returns false if none does.
static bool find_container(EnclosedEyes *found, const Scene *scene, const Census *census, Vec3 eye)
{
    for (size_t i = 0; i < scene->spheres.count; i++) {
        found->sphere = i + 1;
        if (sphere_contains(&scene->spheres.data[i], eye))
            return true;
    }
    found->sphere = 0;
    for (size_t i = 0; i < scene->objects.count; i++) {
        found->object = i;
        if (census->meshes[i].closedness.is_closed &&
            mesh_contains(&scene->objects.data[i].mesh, eye))
            return true;
    }
    return false;
}

EnclosedEyes enclosed_eyes_find(const Scene *scene, const Census *census)
{
    EnclosedEyes first = {0};
    const size_t views = scene->has_course_views ? 1 : scene->viewpoints.count;
    for (size_t view = 0; view < views; view++) {
        EnclosedEyes found = {.count = first.count + 1, .view = view + 1};
        if (!find_container(&found, scene, census, scene->viewpoints.data[view].eye))
            continue;
        if (first.count == 0)
            first = found;
        first.count = found.count;
    }
    return first;
}

// Returns the coordinate along an edge of the picture, in units of the picture's half side.
static double across(Vec3 point, const float half_step[3], uint32_t side)
{
    const Vec3 step = vec3_of_floats(half_step);
    return vec3_dot(point, step) / (vec3_dot(step, step) * side);
}

// Returns whether all corners of a box are behind the eye or beyond one edge of the picture.
static bool is_outside(const CameraData *camera, const Vec3 corners[8], const Scene *scene)
{
    bool all[5] = {true, true, true, true, true};
    for (int corner = 0; corner < 8; corner++) {
        const Vec3 point = vec3_sub(corners[corner], vec3_of_floats(camera->eye));
        const double depth = vec3_dot(point, vec3_of_floats(camera->forward));
        const double x = across(point, camera->right_step, scene->width);
        const double y = across(point, camera->down_step, scene->height);
        const bool outside[5] = {depth<0, x> MARGIN * depth, -x > MARGIN * depth,
                                 y > MARGIN * depth, -y > MARGIN * depth};
        for (int plane = 0; plane < 5; plane++)
            all[plane] = all[plane] && outside[plane];
    }
    return all[0] || all[1] || all[2] || all[3] || all[4];
}

bool is_out_of_view(const Scene *scene, const Normalization *normalization, size_t object)
{
    Vec3 corners[8], low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    const Mesh *mesh = &scene->objects.data[object].mesh;
    mesh_add_bounds(mesh, &low, &high);
    for (int i = 0; i < 8; i++)
        corners[i] =
            normalize_point(normalization, vec3(i & 1 ? low.x : high.x, i & 2 ? low.y : high.y,
                                                i & 4 ? low.z : high.z));
    bool is_out = mesh->triangle_count > 0;
    for (size_t view = 0; is_out && view < scene->viewpoints.count; view++) {
        const CameraData camera = camera_make(&scene->viewpoints.data[view], normalization,
                                              scene->width, scene->height, 1);
        is_out = is_outside(&camera, corners, scene);
    }
    return is_out;
}
