// SPDX-License-Identifier: MIT
// Rounds what host/accel/flat.c and triangles.c round, and nothing else.  Normals are floats in
// the file already; powers of two that they are scaled by change no direction.
#include "oracle/stored.h"

// The volatile is against GCC 12, which leaves out pairs of such conversions (-O2 and above).
static double rounded(double value)
{
    const volatile float stored = (float)value;
    return (double)stored;
}

static Vec3 rounded_point(const Normalization *normalization, Vec3 point)
{
    const Vec3 p = normalize_point(normalization, point);
    return vec3(rounded(p.x), rounded(p.y), rounded(p.z));
}

// As the sum of two floats.
static double split_twice(double value)
{
    return rounded(value) + rounded(value - rounded(value));
}

static void round_sphere(Sphere *sphere, const Normalization *normalization)
{
    const Vec3 center = normalize_point(normalization, sphere->center);
    sphere->center = vec3(split_twice(center.x), split_twice(center.y), split_twice(center.z));
    sphere->radius = split_twice(sphere->radius * normalization->scale);
}

static void round_mesh(Mesh *mesh, const Normalization *normalization)
{
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
        double *position = mesh->positions[vertex];
        const Vec3 p = rounded_point(normalization, vec3(position[0], position[1], position[2]));
        position[0] = p.x;
        position[1] = p.y;
        position[2] = p.z;
    }
}

void stored_round(Scene *scene, const Normalization *normalization)
{
    for (size_t i = 0; i < scene->lights.count; i++) {
        Light *light = &scene->lights.data[i];
        light->position = rounded_point(normalization, light->position);
        light->intensity = rounded(light->intensity);
    }
    for (size_t i = 0; i < scene->spheres.count; i++)
        round_sphere(&scene->spheres.data[i], normalization);
    for (size_t i = 0; i < scene->objects.count; i++)
        round_mesh(&scene->objects.data[i].mesh, normalization);
    scene->ambient = rounded(scene->ambient);
    scene->background = vec3(rounded(scene->background.x), rounded(scene->background.y),
                             rounded(scene->background.z));
}

static Vec3 vector_of(const float components[4])
{
    return vec3((double)components[0], (double)components[1], (double)components[2]);
}

OracleView stored_view(const Oracle *oracle, const CameraData *camera, uint32_t width,
                       uint32_t height)
{
    return (OracleView){.oracle = oracle,
                        .eye = vector_of(camera->eye),
                        .forward = vector_of(camera->forward),
                        .right = vec3_scale(vector_of(camera->right_step), 2),
                        .down = vec3_scale(vector_of(camera->down_step), 2),
                        .width = width,
                        .height = height,
                        .max_level = oracle->scene->max_level};
}
