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

static bool build(GLuint program, const DrawingLayout *layout, Error *error)
{
    const GLuint vertex = compile(GL_VERTEX_SHADER, layout->shader, error);
    const GLuint fragment = vertex == 0 ? 0 : compile(GL_FRAGMENT_SHADER, layout->shader, error);
    if (fragment != 0) {
        glAttachShader(program, vertex);
        glAttachShader(program, fragment);
    }
    for (GLuint i = 0; i < ATTRIBUTES_MOST && layout->attributes[i].name != NULL; i++)
        glBindAttribLocation(program, i, layout->attributes[i].name);
    const bool ok = fragment != 0 && link_program(program, error);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    return ok;
}

bool drawing_open(Drawing *drawing, const DrawingLayout *layout, Error *error)
{
    *drawing = (Drawing){.program = glCreateProgram()};
    glGenVertexArrays(1, &drawing->array);
    glGenBuffers(2, drawing->buffers);
    glBindVertexArray(drawing->array);
    for (GLuint i = 0; i < ATTRIBUTES_MOST && layout->attributes[i].name != NULL; i++) {
        const Attribute *attribute = &layout->attributes[i];
        const int buffer = attribute->buffer;
        glBindBuffer(GL_ARRAY_BUFFER, drawing->buffers[buffer]);
        glVertexAttribPointer(i, attribute->floats, GL_FLOAT, GL_FALSE,
                              (GLsizei)layout->sizes[buffer], (void *)attribute->offset);
        glEnableVertexAttribArray(i);
        if (buffer == 1)
            glVertexAttribDivisor(i, 1);
    }
    glBindVertexArray(0);
    return build(drawing->program, layout, error);
}

void drawing_close(Drawing *drawing)
{
    glDeleteProgram(drawing->program);
    glDeleteVertexArrays(1, &drawing->array);
    glDeleteBuffers(2, drawing->buffers);
    *drawing = (Drawing){0};
}

void drawing_use(const Drawing *drawing)
{
    glUseProgram(drawing->program);
    glBindVertexArray(drawing->array);
}

void drawing_fill(const Drawing *drawing, int buffer, const void *bytes, size_t size)
{
    glBindBuffer(GL_ARRAY_BUFFER, drawing->buffers[buffer]);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, bytes, GL_STATIC_DRAW);
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

// Fills a buffer with cube corners. Bit n of a corner's number is its coordinate along axis n.
static void fill_cube(const Drawing *drawing, const unsigned char *corners, int count, float low)
{
    float vertices[CUBE_FACE_VERTICES][3];
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            vertices[i][axis] = (corners[i] >> axis & 1) != 0 ? 1 : low;
    drawing_fill(drawing, 0, vertices, (size_t)count * sizeof vertices[0]);
}

void cube_fill_faces(const Drawing *drawing)
{
    // The corners are counter-clockwise, seen from outside.
    static const unsigned char corners[CUBE_FACE_VERTICES] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6,
                                                              0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                                              0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    fill_cube(drawing, corners, CUBE_FACE_VERTICES, -1);
}

void cube_fill_edges(const Drawing *drawing)
{
    static const unsigned char corners[CUBE_EDGE_VERTICES + 2] = {
        0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7, 0, 7};
    fill_cube(drawing, corners, CUBE_EDGE_VERTICES + 2, 0);
}
