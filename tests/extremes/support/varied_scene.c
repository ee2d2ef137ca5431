// SPDX-License-Identifier: MIT
// A bumpy globe over a mirroring floor, with two spheres beside it.
#include "varied_scene.h"

#include "check.h"
#include "shapes.h"

// Normals that point away from the center: as smooth as the globe would like to be.
static void add_normals(Mesh *mesh)
{
    Error error = {0};
    mesh->normals = memory_raw(mesh->vertex_count, sizeof *mesh->normals, &error);
    require(mesh->normals != NULL, &error);
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
        for (int axis = 0; axis < 3; axis++)
            mesh->normals[vertex][axis] = (float)mesh->positions[vertex][axis];
}

static void add_globe(Scene *scene)
{
    Random random = {46};
    Mesh globe = shape_bumpy(&random, vec3(0, 0, 0));
    add_normals(&globe);
    shape_add(scene, globe, 2);
}

Scene varied_scene(void)
{
    Error error = {0};
    Scene scene;
    bool ok = scene_init(&scene, &error);
    Material gloss = material_of_shader(SHADER_BLINN_PHONG);
    gloss.shininess = 77.5f;
    gloss.exponent = UINT32_MAX;
    gloss.reflectivity = 0.5f;
    const Light lights[3] = {light_white(vec3(8, -9, 12), 0.7), light_white(vec3(-10, 3, 9), 0.4),
                             light_white(vec3(1, 1, 25), 0.3)};
    const Sphere spheres[2] = {{{6, -4, -3}, 2.5, 4}, {{-7, -5, -2}, 1.5, 3}};
    const Viewpoint viewpoint = {{3, -21, 7}, {0, 0, -1}, {0, 0, 1}, 45};
    ok = ok && array_push(&scene.materials, gloss, &error) &&
         array_push(&scene.viewpoints, viewpoint, &error);
    for (int i = 0; i < 3; i++)
        ok = ok && array_push(&scene.lights, lights[i], &error);
    for (int i = 0; i < 2; i++)
        ok = ok && array_push(&scene.spheres, spheres[i], &error);
    require(ok, &error);
    scene.background = vec3(0.25, 0.5, 0.75);
    add_globe(&scene);
    shape_add(&scene, shape_plane(vec3(-12, -12, -6), vec3(24, 0, 0), vec3(0, 24, 0.5), 7), 3);
    return scene;
}

static void scale_point(Vec3 *point, double scale)
{
    *point = vec3_scale(*point, scale);
}

void varied_scene_scale(Scene *scene, int exponent)
{
    const double scale = ldexp(1, exponent);
    for (size_t i = 0; i < scene->objects.count; i++) {
        Mesh *mesh = &scene->objects.data[i].mesh;
        for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
            for (int axis = 0; axis < 3; axis++)
                mesh->positions[vertex][axis] *= scale;
    }
    for (size_t i = 0; i < scene->lights.count; i++)
        scale_point(&scene->lights.data[i].position, scale);
    for (size_t i = 0; i < scene->spheres.count; i++) {
        scale_point(&scene->spheres.data[i].center, scale);
        scene->spheres.data[i].radius *= scale;
    }
    for (size_t i = 0; i < scene->viewpoints.count; i++) {
        scale_point(&scene->viewpoints.data[i].eye, scale);
        scale_point(&scene->viewpoints.data[i].look_at, scale);
    }
}
