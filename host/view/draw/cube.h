// SPDX-License-Identifier: MIT
// Cubes for OpenGL: faces from -1 to 1, edges from 0 to 1.
#pragma once

#include "view/draw/shader.h"

#define CUBE_FACE_VERTICES 36
#define CUBE_EDGE_VERTICES 24 // followed by the two of a diagonal

// Makes a buffer of triangles or lines, with three floats per vertex, and binds it to the attribute
// of the current vertex array.
GLuint cube_make_faces(GLuint attribute);
GLuint cube_make_edges(GLuint attribute);
