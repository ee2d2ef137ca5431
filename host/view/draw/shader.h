// SPDX-License-Identifier: MIT
// Builds OpenGL programs. One text contains both stages; VERTEX is defined only in the first.
#pragma once

#include "base/error.h"

#include <epoxy/gl.h>

// The files of host/view/shaders, embedded by tools/embed_shaders.cmake.
extern const char shader_triangles[], shader_spheres[], shader_lines[], shader_picture[],
    shader_text[];

// Compiles and links a program. attributes ends with NULL, and its names get the locations 0, 1 and
// so on. On failure, returns 0, and error receives the driver's message.
GLuint shader_build(const char *text, const char *const *attributes, Error *error);

// Set uniforms of the current program by name. Ignore names that the program does not use.
void shader_set_number(GLuint program, const char *name, double value);
void shader_set_integer(GLuint program, const char *name, int value);
void shader_set_vector(GLuint program, const char *name, const float v[3]);

// Describes and enables an attribute of the current vertex array and buffer: its number of floats,
// its vertices' size in bytes and its offset in each.
void shader_set_attribute(GLuint attribute, GLint floats, size_t size, size_t offset);

// Cubes: faces from -1 to 1, edges from 0 to 1.
#define CUBE_FACE_VERTICES 36
#define CUBE_EDGE_VERTICES 24 // followed by the two of a diagonal

// Makes a buffer of triangles or lines, with three floats per vertex, and binds it to the attribute
// of the current vertex array.
GLuint cube_make_faces(GLuint attribute);
GLuint cube_make_edges(GLuint attribute);
