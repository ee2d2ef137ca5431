// SPDX-License-Identifier: MIT
// Computes each sphere's position relative to the eye in fp64 for every frame. In float, the eye's
// height above a ground sphere of radius 1e9 would be lost.
#include "view/draw/draw.h"

#include <stdlib.h>
#include <string.h>

// Floats per sphere: center, radius, and the material's three vectors. The material's unused float,
// at HEIGHT_PLACE, holds the eye's height above the sphere.
#define SPHERE_NUMBERS 16
#define HEIGHT_PLACE   13

bool sphere_view_open(SphereView *view, Error *error)
{
    static const DrawingLayout layout = {shader_spheres,
                                         {3 * sizeof(float), SPHERE_NUMBERS * sizeof(float)},
                                         {{"corner", 0, 3, 0},
                                          {"sphere", 1, 4, 0},
                                          {"diffuse", 1, 4, 4 * sizeof(float)},
                                          {"specular", 1, 4, 8 * sizeof(float)},
                                          {"look", 1, 4, 12 * sizeof(float)}}};
    *view = (SphereView){0};
    const bool ok = drawing_open(&view->drawing, &layout, error);
    cube_fill_faces(&view->drawing);
    return ok;
}

void sphere_view_close(SphereView *view)
{
    drawing_close(&view->drawing);
    free(view->numbers.memory);
    *view = (SphereView){0};
}

bool sphere_view_load(SphereView *view, const Model *model, Error *error)
{
    return array_reserve(&view->numbers.memory, &view->numbers.capacity,
                         SPHERE_NUMBERS * model->scene.spheres.count, sizeof(float), error);
}

static void store_sphere(float *numbers, const Model *model, const Sphere *sphere, Vec3 eye)
{
    float material[3][4];
    const Vec3 place = normalize_point(&model->normalization, sphere->center);
    const Vec3 offset = vec3_sub(place, eye);
    const double radius = sphere->radius * model->normalization.scale;
    light_store_material(material, &model->scene.materials.data[sphere->material]);
    vec3_store(numbers, offset);
    numbers[3] = (float)radius;
    memcpy(numbers + 4, material, sizeof material);
    numbers[HEIGHT_PLACE] = (float)(sqrt(vec3_dot(offset, offset)) - radius);
}

void sphere_view_draw(SphereView *view, const Model *model, const Lens *lens, const Tone *tone)
{
    const Scene *scene = &model->scene;
    const size_t count = scene->spheres.count;
    if (count == 0)
        return;
    for (size_t i = 0; i < count; i++)
        store_sphere(view->numbers.data + SPHERE_NUMBERS * i, model, &scene->spheres.data[i],
                     lens->eye);
    drawing_use(&view->drawing);
    lens_apply(lens, view->drawing.program);
    light_apply(scene, &model->normalization, tone, view->drawing.program);
    drawing_fill(&view->drawing, 1, view->numbers.data, SPHERE_NUMBERS * count * sizeof(float));
    // Draws back faces, because they cover the sphere even if the eye is inside the cube.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glDrawArraysInstanced(GL_TRIANGLES, 0, CUBE_FACE_VERTICES, (GLsizei)count);
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
}
