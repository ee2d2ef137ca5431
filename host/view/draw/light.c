// SPDX-License-Identifier: MIT
// Converts a scene's lights and materials to the shaders' layout.
#include "view/draw/light.h"

#include <string.h>

static int store_lights(float lights[LIGHT_LIMIT][4], float colors[LIGHT_LIMIT][3],
                        const Scene *scene, const Normalization *normalization)
{
    size_t count = 0;
    for (; count < scene->lights.count && count < LIGHT_LIMIT; count++) {
        const Light *light = &scene->lights.data[count];
        const Vec3 place = normalize_point(normalization, light->position);
        lights[count][0] = (float)place.x;
        lights[count][1] = (float)place.y;
        lights[count][2] = (float)place.z;
        lights[count][3] = (float)light->intensity;
        colors[count][0] = (float)light->color.x;
        colors[count][1] = (float)light->color.y;
        colors[count][2] = (float)light->color.z;
    }
    return (int)count;
}

void light_apply(const Scene *scene, const Normalization *normalization, const Tone *tone,
                 GLuint program)
{
    float lights[LIGHT_LIMIT][4], colors[LIGHT_LIMIT][3];
    const int count = store_lights(lights, colors, scene, normalization);
    const float background[3] = {(float)scene->background.x, (float)scene->background.y,
                                 (float)scene->background.z};
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
