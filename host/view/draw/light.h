// SPDX-License-Identifier: MIT
// The scene's lights and materials -> the uniforms of shaders/light.glsl.
#pragma once

#include "scene/normalize.h"
#include "view/draw/shader.h"

// The largest number of lights. The course's viewer has eight, because it uses OpenGL's fixed
// pipeline.
#define LIGHT_LIMIT 64

// The conversion of colors for the window.
typedef struct {
    double gain;
    bool is_srgb;
} Tone;

// Sets the uniforms of the lights, which all objects share. program must be the current program.
void light_apply(const Scene *scene, const Normalization *normalization, const Tone *tone,
                 GLuint program);

// Packs a material into three vectors: diffuse and kd; specular and ks; shader, 0, shininess and
// reflectivity.
void light_store_material(float vectors[3][4], const Material *material);
