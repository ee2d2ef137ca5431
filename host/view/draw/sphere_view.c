// SPDX-License-Identifier: MIT
// Computes each sphere's position relative to the eye in fp64 for every frame. For a ground sphere
// of radius 1e9, float cannot resolve this position.
#include "view/draw/draw.h"

#include <stdlib.h>
#include <string.h>

// Center, radius and three vectors of the material, with the eye's height above the sphere at
// HEIGHT_PLACE.
#define SPHERE_NUMBERS 16
#define HEIGHT_PLACE   13

bool sphere_view_open(SphereView *view, Error *error)
{
    static const char *const attributes[] = {"corner",   "sphere", "diffuse",
                                             "specular", "look",   NULL};
    *view = (SphereView){.program = shader_build(shader_spheres, attributes, error)};
    if (view->program == 0)
        return false;
    glGenVertexArrays(1, &view->array);
    glBindVertexArray(view->array);
    view->corners = cube_make_faces(0);
    glGenBuffers(1, &view->spheres);
    glBindBuffer(GL_ARRAY_BUFFER, view->spheres);
    for (GLuint vector = 0; vector < 4; vector++) {
        shader_set_attribute(vector + 1, 4, SPHERE_NUMBERS * sizeof(float),
                             vector * 4 * sizeof(float));
        glVertexAttribDivisor(vector + 1, 1);
    }
    glBindVertexArray(0);
    return true;
}

void sphere_view_close(SphereView *view)
{
    glDeleteProgram(view->program);
    glDeleteVertexArrays(1, &view->array);
    glDeleteBuffers(1, &view->corners);
    glDeleteBuffers(1, &view->spheres);
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
    glUseProgram(view->program);
    glBindVertexArray(view->array);
    lens_apply(lens, view->program);
    light_apply(scene, &model->normalization, tone, view->program);
    glBindBuffer(GL_ARRAY_BUFFER, view->spheres);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(SPHERE_NUMBERS * count * sizeof(float)),
                 view->numbers.data, GL_STREAM_DRAW);
    // Draws back faces, because they cover the sphere even if the eye is inside the cube.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glDrawArraysInstanced(GL_TRIANGLES, 0, CUBE_FACE_VERTICES, (GLsizei)count);
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
}
