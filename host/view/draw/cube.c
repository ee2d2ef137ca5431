// SPDX-License-Identifier: MIT
// Bit n of a corner's number selects the corner's coordinate along axis n.
#include "view/draw/cube.h"

static GLuint make(GLuint attribute, const unsigned char *corners, int count, float low)
{
    GLuint buffer;
    float vertices[CUBE_FACE_VERTICES][3];
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            vertices[i][axis] = (corners[i] >> axis & 1) != 0 ? 1 : low;
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)count * sizeof vertices[0]), vertices,
                 GL_STATIC_DRAW);
    glVertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    glEnableVertexAttribArray(attribute);
    return buffer;
}

GLuint cube_make_faces(GLuint attribute)
{
    // The corners are counter-clockwise, seen from outside.
    static const unsigned char corners[CUBE_FACE_VERTICES] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6,
                                                              0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                                              0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return make(attribute, corners, CUBE_FACE_VERTICES, -1);
}

GLuint cube_make_edges(GLuint attribute)
{
    static const unsigned char corners[CUBE_EDGE_VERTICES + 2] = {
        0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7, 0, 7};
    return make(attribute, corners, CUBE_EDGE_VERTICES + 2, 0);
}
