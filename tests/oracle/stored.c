// SPDX-License-Identifier: MIT
// Rounds exactly the numbers that host/accel/flat.c and triangles.c round. Normals of files are
// floats already. Missing normals are replaced by the face's normal before points are rounded.
#include "oracle/stored.h"

#include <stdlib.h>
#include <string.h>

// volatile is necessary because GCC 12 removes the two conversions with -O2.
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

// Returns the value rounded to the sum of two floats.
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

static Vec3 corner_of(const Mesh *mesh, const uint32_t corners[3], int corner)
{
    const double *position = mesh->positions[corners[corner]];
    return vec3(position[0], position[1], position[2]);
}

static void store_face(const Mesh *mesh, const uint32_t corners[3], float normal[3])
{
    const Vec3 a = corner_of(mesh, corners, 0);
    const Vec3 face = vec3_normalize(vec3_cross(vec3_sub(corner_of(mesh, corners, 1), a),
                                                vec3_sub(corner_of(mesh, corners, 2), a)));
    normal[0] = (float)face.x;
    normal[1] = (float)face.y;
    normal[2] = (float)face.z;
}

// Gives each triangle its own vertices, and every vertex a normal. Colors stay with their corners.
static bool complete_normals(Mesh *mesh, Error *error)
{
    static const float none[3];
    const size_t count = 3 * mesh->triangle_count;
    Mesh own = {.vertex_count = count};
    const bool ok = mesh_allocate_vertices(&own, true, mesh->colors != NULL, error);
    for (size_t i = 0; ok && i < count; i++) {
        const uint32_t *corners = mesh->triangles[i / 3];
        memcpy(own.positions[i], mesh->positions[corners[i % 3]], sizeof *own.positions);
        memcpy(own.normals[i], mesh->normals[corners[i % 3]], sizeof *own.normals);
        if (memcmp(own.normals[i], none, sizeof none) == 0)
            store_face(mesh, corners, own.normals[i]);
        if (mesh->colors != NULL)
            memcpy(own.colors[i], mesh->colors[corners[i % 3]], sizeof *own.colors);
    }
    for (size_t i = 0; i < count; i++)
        mesh->triangles[i / 3][i % 3] = (uint32_t)i;
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->colors);
    mesh->positions = own.positions;
    mesh->normals = own.normals;
    mesh->colors = own.colors;
    mesh->vertex_count = count;
    return ok;
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

static void round_checker(Material *material, const Normalization *normalization)
{
    const Vec3 center = normalization->center;
    const double size = (double)material->check_size;
    if (!(size > 0))
        return;
    material->check_rate = (float)(1 / (size * normalization->scale));
    material->check_shift[0] = (float)remainder(center.x / size, 2);
    material->check_shift[1] = (float)remainder(center.y / size, 2);
    material->check_shift[2] = (float)remainder(center.z / size, 2);
}

bool stored_round(Scene *scene, const Normalization *normalization, Error *error)
{
    for (size_t i = 0; i < scene->lights.count; i++) {
        Light *light = &scene->lights.data[i];
        if (light->is_sun) {
            const Vec3 unit = vec3_normalize(light->position);
            light->position = vec3(rounded(unit.x), rounded(unit.y), rounded(unit.z));
        } else {
            light->position = rounded_point(normalization, light->position);
        }
        light->intensity = rounded(light->intensity);
        light->color =
            vec3(rounded(light->color.x), rounded(light->color.y), rounded(light->color.z));
    }
    for (size_t i = 0; i < scene->materials.count; i++)
        round_checker(&scene->materials.data[i], normalization);
    for (size_t i = 0; i < scene->spheres.count; i++)
        round_sphere(&scene->spheres.data[i], normalization);
    for (size_t i = 0; i < scene->objects.count; i++) {
        Mesh *mesh = &scene->objects.data[i].mesh;
        if (mesh->normals != NULL && !complete_normals(mesh, error))
            return false;
        round_mesh(mesh, normalization);
    }
    scene->ambient = rounded(scene->ambient);
    scene->background = vec3(rounded(scene->background.x), rounded(scene->background.y),
                             rounded(scene->background.z));
    return true;
}

static Vec3 vector_of(const float components[3])
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
                        .is_parallel = camera->orthographic != 0,
                        .width = width,
                        .height = height,
                        .max_level = oracle->scene->max_level};
}
