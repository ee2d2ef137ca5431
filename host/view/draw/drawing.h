// SPDX-License-Identifier: MIT
// Builds OpenGL programs, and sets their uniforms. A shader file contains both stages; VERTEX is
// defined only in the vertex stage.
#pragma once

#include "scene/camera.h"
#include "scene/normalize.h"

#include <epoxy/gl.h>
#include <stdint.h>

// The shaders of host/view/shaders. tools/embed_shaders.cmake embeds them with their included
// files.
extern const char shader_triangles[], shader_spheres[], shader_lines[], shader_text[];

#define ATTRIBUTES_MOST 8

// A shader and its attributes. Buffer 0 has an element for each vertex or, if has_instances is
// true, for each instance. An element has the floats of all attributes, in the order of
// `attributes`.
typedef struct {
    const char *shader;
    bool has_instances;
    struct {
        const char *name; // NULL if unused
        GLint floats;     // 0 if the caller sets the attribute's pointer
    } attributes[ATTRIBUTES_MOST];
} DrawingLayout;

// A program and its buffers. Buffer 0 has the attributes, and buffer 1 has the indices of the
// triangles' corners.
typedef struct {
    GLuint program, array, buffers[2];
} Drawing;

// Compiles the shader and makes empty buffers. On failure, stores the driver's message in *error.
// The caller closes the drawing, even after a failure.
bool drawing_open(Drawing *drawing, const DrawingLayout *layout, Error *error);
void drawing_close(Drawing *drawing);

// Makes the program and its vertex array current.
void drawing_use(const Drawing *drawing);

void drawing_fill(const Drawing *drawing, int buffer, const void *bytes, size_t size);

// Sets a uniform of `program`, which must be current. Ignores names that the program does not use.
void drawing_set_vector(GLuint program, const char *name, const float v[3]);

// The following declarations convert the scene's lights and materials to the uniforms of
// shaders/light.glsl.

// The largest number of lights that OpenGL shows.
#define LIGHT_LIMIT 64

// The conversion of colors for the window.
typedef struct {
    double gain;
    bool is_srgb;
} Tone;

// Sets the uniforms that objects share: lights, ambient light, background and tone. `program` must
// be current.
void light_apply(const Scene *scene, const Normalization *normalization, const Tone *tone,
                 GLuint program);

// Packs a material into six vectors of four numbers: diffuse and kd; specular and ks; shader, 0,
// shininess and reflectivity; the color of the checker's even cubes and check_rate; the color of
// its odd cubes and 0; check_shift and 0.
#define MATERIAL_VECTORS 6
void light_store_material(float vectors[MATERIAL_VECTORS][4], const Material *material,
                          const Normalization *normalization);

// A projection that makes OpenGL draw the same picture as the rays of a camera.
typedef struct {
    CameraData camera;   // in normalized coordinates; a step is half a pixel
    Vec3 eye;            // in normalized coordinates, in fp64
    float width, height; // of the picture, in pixels
    float farthest;      // distances above this one all have depth 1; 0 for perspective
} Lens;

Lens lens_of(const Viewpoint *viewpoint, const Normalization *normalization, uint32_t width,
             uint32_t height);

// Sets the uniforms of lens.glsl in `program`, which must be current.
void lens_apply(const Lens *lens, GLuint program);
