// SPDX-License-Identifier: MIT
// The scene's lights and materials as what shaders/light.glsl reads.
#pragma once

#include "scene/normalize.h"
#include "view/draw/shader.h"

// So many lights count; more than the course's viewer shows, whose OpenGL has eight.
#define LIGHT_LIMIT 64

// How colors become those of the window.
typedef struct {
    double gain;
    bool is_srgb;
} Tone;

// Sets the uniforms that all objects share in the program in use.
void light_apply(const Scene *scene, const Normalization *normalization, const Tone *tone,
                 GLuint program);

// A material as three vectors: color and kd, highlight and ks, and the rest; the second number of
// the last is free.
void light_store_material(float vectors[3][4], const Material *material);
