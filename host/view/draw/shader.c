// SPDX-License-Identifier: MIT
// Uses GLSL 1.40, which OpenGL 3.1 to 4.6 accept in all profiles.
#include "view/draw/shader.h"

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
