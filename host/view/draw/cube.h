// SPDX-License-Identifier: MIT
// Cubes as OpenGL draws them: faces from -1 to 1, edges from 0 to 1.
#pragma once

#include "view/draw/shader.h"

#define CUBE_FACE_VERTICES 36
#define CUBE_EDGE_VERTICES 24 // a diagonal follows them, of two

// Makes a buffer of triangles or of lines, three floats a vertex, and lets the vertex array that is
// bound read that attribute from it.
GLuint cube_make_faces(GLuint attribute);
GLuint cube_make_edges(GLuint attribute);
