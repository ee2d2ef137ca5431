// SPDX-License-Identifier: MIT
// A bumpy globe over a mirroring floor, with two spheres beside it.
#include "varied_scene.h"

#include "check.h"
#include "shapes.h"
#include "unit/parsed.h"

// The vertex normals point away from the center.
static Mesh smooth_globe(void)
{
    Random random = {46};
    Mesh globe = shape_bumpy(&random, vec3(0, 0, 0));
    globe.normals = require_memory(globe.vertex_count, sizeof *globe.normals);
    for (size_t vertex = 0; vertex < globe.vertex_count; vertex++)
        shape_store(globe.normals[vertex], shape_vertex(&globe, vertex));
    return globe;
}

Scene varied_scene(void)
{
    Scene scene = parsed_format("background 0.25 0.5 0.75\n"
                                "light 8 -9 12 0.7\nlight -10 3 9 0.4\nlight 1 1 25 0.3\n"
                                "camera 3 -21 7 0 0 -1 45\n"
                                "define gloss blinn_phong shininess 77.5 reflectivity 0.5\n"
                                "material gloss\nsphere 6 -4 -3 2.5\n"
                                "material 3\nsphere -7 -5 -2 1.5\n");
    shape_add(&scene, smooth_globe(), 2);
    shape_add(&scene, shape_plane(vec3(-12, -12, -6), vec3(24, 0, 0), vec3(0, 24, 0.5), 7), 3);
    return scene;
}

static Vec3 placed(Vec3 point, double scale, Vec3 move)
{
    return vec3_add(vec3_scale(point, scale), move);
}

void varied_scene_place(Scene *scene, double scale, Vec3 move)
{
    for (size_t i = 0; i < scene->objects.count; i++) {
        Mesh *mesh = &scene->objects.data[i].mesh;
        for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
            shape_set_vertex(mesh, vertex, placed(shape_vertex(mesh, vertex), scale, move));
    }
    for (size_t i = 0; i < scene->lights.count; i++)
        scene->lights.data[i].position = placed(scene->lights.data[i].position, scale, move);
    for (size_t i = 0; i < scene->spheres.count; i++) {
        scene->spheres.data[i].center = placed(scene->spheres.data[i].center, scale, move);
        scene->spheres.data[i].radius *= scale;
    }
    Viewpoint *view = &scene->viewpoints.data[0];
    view->eye = placed(view->eye, scale, move);
    view->look_at = placed(view->look_at, scale, move);
}
