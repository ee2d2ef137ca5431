// SPDX-License-Identifier: MIT
// The scene's lights and materials -> the uniforms of shaders/light.glsl.
#pragma once

#include "scene/normalize.h"
#include "view/draw/shader.h"

// The largest number of lights; the course's viewer, on OpenGL's fixed pipeline, has eight.
#define LIGHT_LIMIT 64

// The conversion of colors for the window.
typedef struct {
    double gain;
    bool is_srgb;
} Tone;

// Sets the uniforms shared by all objects, in the current program.
void light_apply(const Scene *scene, const Normalization *normalization, const Tone *tone,
                 GLuint program);

// Packs a material into three vectors: color and kd, specular color and ks, and the rest.  The
// second number of the last vector is unused.
void light_store_material(float vectors[3][4], const Material *material);
