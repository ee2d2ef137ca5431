// SPDX-License-Identifier: MIT
// Shader text -> OpenGL program.  One text holds both stages: VERTEX is defined in the first.
#pragma once

#include "base/error.h"

#include <epoxy/gl.h>

// The files of host/view/shaders, made part of the program by tools/embed_shaders.cmake.
extern const char shader_triangles[], shader_spheres[], shader_lines[], shader_picture[],
    shader_text[];

// Compiles and links; attributes gets the places 0, 1, ... in the order of the names, which end
// with NULL.  0 with the driver's reason where it cannot be built.
GLuint shader_build(const char *text, const char *const *attributes, Error *error);

// Sets uniforms of the program in use, by name; those it does without are passed over.
void shader_set_number(GLuint program, const char *name, double value);
void shader_set_integer(GLuint program, const char *name, int value);
void shader_set_vector(GLuint program, const char *name, const float v[3]);
