// SPDX-License-Identifier: MIT
// The camera's steps are half a pixel, so half the picture's width has as many steps as the width
// has pixels.
#include "view/draw/draw.h"

#include <string.h>

// In normalized coordinates, where the triangles' box is 1 to 2 long. All nearer points have depth
// 0, so the one drawn last is visible.
#define NEAREST 0.01f

// Stores step's direction, scaled so that its dot product with points on the picture's edge at
// depth 1 is 1.
static void store_clip(float clip[3], const float step[4], double pixels)
{
    const Vec3 v = vec3_of_floats(step);
    const double length = sqrt(vec3_dot(v, v));
    vec3_store(clip, vec3_scale(v, 1 / (length * length * pixels)));
}

Lens lens_of(const Viewpoint *viewpoint, const Normalization *normalization, uint32_t width,
             uint32_t height)
{
    Lens lens = {.camera = camera_make(viewpoint, normalization, width, height, 1),
                 .eye = normalize_point(normalization, viewpoint->eye),
                 .width = (float)width,
                 .height = (float)height,
                 .nearest = NEAREST};
    store_clip(lens.clip_x, lens.camera.right_step, width);
    store_clip(lens.clip_y, lens.camera.down_step, -(double)height);
    return lens;
}

void lens_apply(const Lens *lens, GLuint program)
{
    shader_set_vector(program, "eye", lens->camera.eye);
    shader_set_vector(program, "forward", lens->camera.forward);
    shader_set_vector(program, "clip_x", lens->clip_x);
    shader_set_vector(program, "clip_y", lens->clip_y);
    shader_set_vector(program, "right_step", lens->camera.right_step);
    shader_set_vector(program, "down_step", lens->camera.down_step);
    shader_set_number(program, "nearest", (double)lens->nearest);
    glUniform2f(glGetUniformLocation(program, "size"), lens->width, lens->height);
}

// Converts a scene's lights and materials to the shaders' layout.

static int store_lights(float lights[LIGHT_LIMIT][4], float colors[LIGHT_LIMIT][3],
                        const Scene *scene, const Normalization *normalization)
{
    size_t count = 0;
    for (; count < scene->lights.count && count < LIGHT_LIMIT; count++) {
        const Light *light = &scene->lights.data[count];
        vec3_store(lights[count], normalize_point(normalization, light->position));
        lights[count][3] = (float)light->intensity;
        vec3_store(colors[count], light->color);
    }
    return (int)count;
}

void light_apply(const Scene *scene, const Normalization *normalization, const Tone *tone,
                 GLuint program)
{
    float lights[LIGHT_LIMIT][4], colors[LIGHT_LIMIT][3];
    const int count = store_lights(lights, colors, scene, normalization);
    float background[3];
    vec3_store(background, scene->background);
    glUniform4fv(glGetUniformLocation(program, "lights"), count, lights[0]);
    glUniform3fv(glGetUniformLocation(program, "light_colors"), count, colors[0]);
    shader_set_integer(program, "light_count", count);
    shader_set_vector(program, "background", background);
    shader_set_number(program, "ambient", scene->ambient);
    shader_set_number(program, "gain", tone->gain);
    shader_set_integer(program, "is_srgb", tone->is_srgb);
}

void light_store_material(float vectors[3][4], const Material *material)
{
    memcpy(vectors[0], material->diffuse, sizeof material->diffuse);
    vectors[0][3] = material->kd;
    memcpy(vectors[1], material->specular, sizeof material->specular);
    vectors[1][3] = material->ks;
    vectors[2][0] = (float)material->shader;
    vectors[2][1] = 0;
    vectors[2][2] = material->shininess;
    vectors[2][3] = material->reflectivity;
}
