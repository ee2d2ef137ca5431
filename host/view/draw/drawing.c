// SPDX-License-Identifier: MIT
// Compiles shaders, and sets the uniforms of lights and cameras. The shaders use GLSL 1.40, which
// OpenGL 3.1 to 4.6 accept in all profiles.
#include "view/draw/drawing.h"

#include <string.h>

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
    glBindBuffer(GL_ARRAY_BUFFER, drawing->buffers[0]);
    GLint stride = 0, offset = 0; // in floats
    for (int i = 0; i < ATTRIBUTES_MOST; i++)
        stride += layout->attributes[i].floats;
    for (GLuint i = 0; i < ATTRIBUTES_MOST && layout->attributes[i].floats > 0; i++) {
        const GLint floats = layout->attributes[i].floats;
        glVertexAttribPointer(i, floats, GL_FLOAT, GL_FALSE, stride * (GLint)sizeof(float),
                              (void *)((size_t)offset * sizeof(float)));
        glEnableVertexAttribArray(i);
        glVertexAttribDivisor(i, layout->has_instances);
        offset += floats;
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

static void set_number(GLuint program, const char *name, double value)
{
    glUniform1f(glGetUniformLocation(program, name), (GLfloat)value);
}

static void set_integer(GLuint program, const char *name, int value)
{
    glUniform1i(glGetUniformLocation(program, name), value);
}

void drawing_set_vector(GLuint program, const char *name, const float v[3])
{
    glUniform3fv(glGetUniformLocation(program, name), 1, v);
}

// The following functions convert a camera to the uniforms of lens.glsl.

// The depth range of an orthographic picture ends at least this far behind the origin of normalized
// coordinates. All triangles are within this distance of the origin.
#define BEYOND 2

Lens lens_of(const Viewpoint *viewpoint, const Normalization *normalization, uint32_t width,
             uint32_t height)
{
    Lens lens = {.camera = camera_make(viewpoint, normalization, width, height, 1),
                 .eye = normalize_point(normalization, viewpoint->eye),
                 .width = (float)width,
                 .height = (float)height};
    if (viewpoint->height > 0)
        lens.farthest = (float)(vec3_length(lens.eye) + BEYOND);
    return lens;
}

void lens_apply(const Lens *lens, GLuint program)
{
    drawing_set_vector(program, "eye", lens->camera.eye);
    drawing_set_vector(program, "forward", lens->camera.forward);
    drawing_set_vector(program, "right_step", lens->camera.right_step);
    drawing_set_vector(program, "down_step", lens->camera.down_step);
    set_number(program, "farthest", (double)lens->farthest);
    glUniform2f(glGetUniformLocation(program, "size"), lens->width, lens->height);
}

// The following functions convert a scene's lights and materials to the shaders' layout.

// Returns one light that replaces the scene's lights [first, end). It has the total intensity of
// these lights, and the means of their colors and normalized positions, weighted by intensity.
static Light mean_light(const Scene *scene, size_t first, size_t end,
                        const Normalization *normalization)
{
    Light mean = {.intensity = 0};
    for (size_t i = first; i < end; i++)
        mean.intensity += scene->lights.data[i].intensity;
    for (size_t i = first; i < end; i++) {
        const Light *light = &scene->lights.data[i];
        const double share = mean.intensity > 0 ? light->intensity / mean.intensity : 0;
        const Vec3 position = normalize_light(normalization, light);
        mean.position = vec3_add(mean.position, vec3_scale(position, share));
        mean.color = vec3_add(mean.color, vec3_scale(light->color, share));
    }
    return mean;
}

// If there are more than LIGHT_LIMIT lights, neighbors in the list become one light. Neighbors are
// mostly points of one area light.
static int store_lights(float lights[LIGHT_LIMIT][4], float colors[LIGHT_LIMIT][3],
                        const Scene *scene, const Normalization *normalization)
{
    const size_t all = scene->lights.count, count = all < LIGHT_LIMIT ? all : LIGHT_LIMIT;
    for (size_t i = 0; i < count; i++) {
        const Light light =
            mean_light(scene, all * i / count, all * (i + 1) / count, normalization);
        vec3_store(lights[i], light.position);
        lights[i][3] = (float)light.intensity;
        vec3_store(colors[i], light.color);
    }
    return (int)count;
}

void light_apply(const Scene *scene, const Normalization *normalization, const Tone *tone,
                 GLuint program)
{
    float lights[LIGHT_LIMIT][4], colors[LIGHT_LIMIT][3];
    const int count = store_lights(lights, colors, scene, normalization);
    float background[3];
    vec3_store(background, scene->background);
    glUniform4fv(glGetUniformLocation(program, "lights"), count, lights[0]);
    glUniform3fv(glGetUniformLocation(program, "light_colors"), count, colors[0]);
    set_integer(program, "light_count", count);
    drawing_set_vector(program, "background", background);
    set_number(program, "ambient", scene->ambient);
    set_number(program, "gain", tone->gain);
    set_integer(program, "is_srgb", tone->is_srgb);
}

void light_store_material(float vectors[MATERIAL_VECTORS][4], const Material *material,
                          const Normalization *normalization)
{
    Material placed = *material;
    normalize_checker(&placed, normalization);
    memcpy(vectors[0], material->diffuse, sizeof material->diffuse);
    vectors[0][3] = material->kd;
    memcpy(vectors[1], material->specular, sizeof material->specular);
    vectors[1][3] = material->ks;
    vectors[2][0] = (float)material->shader;
    vectors[2][1] = 0;
    vectors[2][2] = material->shininess;
    vectors[2][3] = material->reflectivity;
    memcpy(vectors[3], placed.checks[0], sizeof placed.checks[0]);
    vectors[3][3] = placed.check_rate;
    memcpy(vectors[4], placed.checks[1], sizeof placed.checks[1]);
    vectors[4][3] = 0;
    memcpy(vectors[5], placed.check_shift, sizeof placed.check_shift);
    vectors[5][3] = 0;
}
