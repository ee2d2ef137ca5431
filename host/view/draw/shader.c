// SPDX-License-Identifier: MIT
// Uses GLSL 1.40, which OpenGL 3.1 to 4.6 accept in all profiles.
#include "view/draw/draw.h"

#define MESSAGE_SIZE 1024

static GLuint compile(GLenum stage, const char *text, Error *error)
{
    const char *texts[] = {"#version 140\n", stage == GL_VERTEX_SHADER ? "#define VERTEX\n" : "",
                           text};
    const GLuint shader = glCreateShader(stage);
    GLint compiled = GL_FALSE;
    glShaderSource(shader, 3, texts, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE)
        return shader;
    char message[MESSAGE_SIZE] = "";
    glGetShaderInfoLog(shader, sizeof message, NULL, message);
    error_set(error, "OpenGL does not compile a shader: %s", message);
    glDeleteShader(shader);
    return 0;
}

static bool link_program(GLuint program, Error *error)
{
    GLint linked = GL_FALSE;
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE)
        return true;
    char message[MESSAGE_SIZE] = "";
    glGetProgramInfoLog(program, sizeof message, NULL, message);
    return error_set(error, "OpenGL does not link a program: %s", message);
}

GLuint shader_build(const char *text, const char *const *attributes, Error *error)
{
    const GLuint vertex = compile(GL_VERTEX_SHADER, text, error);
    const GLuint fragment = vertex == 0 ? 0 : compile(GL_FRAGMENT_SHADER, text, error);
    GLuint program = fragment == 0 ? 0 : glCreateProgram();
    if (program != 0) {
        glAttachShader(program, vertex);
        glAttachShader(program, fragment);
        for (GLuint place = 0; attributes[place] != NULL; place++)
            glBindAttribLocation(program, place, attributes[place]);
        if (!link_program(program, error)) {
            glDeleteProgram(program);
            program = 0;
        }
    }
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    return program;
}

void shader_set_number(GLuint program, const char *name, double value)
{
    glUniform1f(glGetUniformLocation(program, name), (GLfloat)value);
}

void shader_set_integer(GLuint program, const char *name, int value)
{
    glUniform1i(glGetUniformLocation(program, name), value);
}

void shader_set_vector(GLuint program, const char *name, const float v[3])
{
    glUniform3fv(glGetUniformLocation(program, name), 1, v);
}

void shader_set_attribute(GLuint attribute, GLint floats, size_t size, size_t offset)
{
    glVertexAttribPointer(attribute, floats, GL_FLOAT, GL_FALSE, (GLsizei)size, (void *)offset);
    glEnableVertexAttribArray(attribute);
}

// Makes a buffer of cube corners. Bit n of a corner's number is its coordinate along axis n.
static GLuint make_cube(GLuint attribute, const unsigned char *corners, int count, float low)
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
    shader_set_attribute(attribute, 3, sizeof vertices[0], 0);
    return buffer;
}

GLuint cube_make_faces(GLuint attribute)
{
    // The corners are counter-clockwise, seen from outside.
    static const unsigned char corners[CUBE_FACE_VERTICES] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6,
                                                              0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                                              0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return make_cube(attribute, corners, CUBE_FACE_VERTICES, -1);
}

GLuint cube_make_edges(GLuint attribute)
{
    static const unsigned char corners[CUBE_EDGE_VERTICES + 2] = {
        0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7, 0, 7};
    return make_cube(attribute, corners, CUBE_EDGE_VERTICES + 2, 0);
}
