// SPDX-License-Identifier: MIT
// Everything that OpenGL draws: a model's triangles, spheres and boxes, traced pictures and text.
#pragma once

#include "base/array.h"
#include "base/error.h"
#include "base/file.h"
#include "image/framebuffer.h"
#include "scene/camera.h"
#include "scene/normalize.h"
#include "view/draw/canvas.h"
#include "view/model.h"

#include <epoxy/gl.h>
#include <stb/stb_truetype.h>
#include <stdint.h>

// Builds OpenGL programs. A shader file contains both stages; VERTEX is defined only in the vertex
// stage.

// The files of host/view/shaders, embedded by tools/embed_shaders.cmake.
extern const char shader_triangles[], shader_spheres[], shader_lines[], shader_picture[],
    shader_text[];

// An attribute of a shader. Buffer 0 has attributes per vertex, buffer 1 attributes per instance.
typedef struct {
    const char *name;
    int buffer;
    GLint floats; // number of floats
    size_t offset;
} Attribute;

#define ATTRIBUTES_MOST 5

typedef struct {
    const char *shader;
    size_t sizes[2];                       // bytes per element of each buffer
    Attribute attributes[ATTRIBUTES_MOST]; // unused ones have no name
} DrawingLayout;

// A program and the buffers that it reads.
typedef struct {
    GLuint program, array, buffers[2];
} Drawing;

// Compiles the shader and makes empty buffers. On failure, error receives the driver's message. The
// caller closes the drawing, even after a failure.
bool drawing_open(Drawing *drawing, const DrawingLayout *layout, Error *error);
void drawing_close(Drawing *drawing);

// Makes the program and its vertex array current.
void drawing_use(const Drawing *drawing);

// Replaces the contents of a buffer.
void drawing_fill(const Drawing *drawing, int buffer, const void *bytes, size_t size);

// Set uniforms of the current program by name. Ignore names that the program does not use.
void shader_set_number(GLuint program, const char *name, double value);
void shader_set_integer(GLuint program, const char *name, int value);
void shader_set_vector(GLuint program, const char *name, const float v[3]);

// Cubes: coordinates are -1 or 1 for faces, and 0 or 1 for edges.
#define CUBE_FACE_VERTICES 36
#define CUBE_EDGE_VERTICES 24 // after them, the buffer has the two vertices of a diagonal

// Fill buffer 0 with triangles or lines, three floats per vertex.
void cube_fill_faces(const Drawing *drawing);
void cube_fill_edges(const Drawing *drawing);

// The scene's lights and materials -> the uniforms of shaders/light.glsl.

// The most lights that OpenGL shows. The course's viewer has eight, because it uses OpenGL's fixed
// pipeline.
#define LIGHT_LIMIT 64

// The conversion of colors for the window.
typedef struct {
    double gain;
    bool is_srgb;
} Tone;

// Sets the uniforms that objects share: lights, background, tone. program must be the current one.
void light_apply(const Scene *scene, const Normalization *normalization, const Tone *tone,
                 GLuint program);

// Packs a material into three vectors: diffuse and kd; specular and ks; shader, 0, shininess and
// reflectivity.
void light_store_material(float vectors[3][4], const Material *material);

// The camera of the rays -> the projection with which OpenGL draws the same picture.
typedef struct {
    CameraData camera; // in the normalized frame; a step is half a pixel
    Vec3 eye;          // in the normalized frame, in fp64
    float clip_x[3], clip_y[3];
    float width, height; // of the picture, in pixels
    float nearest;       // smaller distances all have depth 0
} Lens;

Lens lens_of(const Viewpoint *viewpoint, const Normalization *normalization, uint32_t width,
             uint32_t height);

// Sets the lens's uniforms in the current program.
void lens_apply(const Lens *lens, GLuint program);

bool triangle_view_open(Drawing *view, Error *error);

// Copies the model's triangles into the OpenGL buffers, in place of the previous triangles.
bool triangle_view_load(const Drawing *view, const Model *model, Error *error);

// Draws the triangles as seen through lens, with colors converted by tone.
void triangle_view_draw(const Drawing *view, const Model *model, const Lens *lens,
                        const Tone *tone);

// Spheres, exact in every pixel.
typedef struct {
    Drawing drawing;
    ARRAY(float) numbers; // of all spheres, in OpenGL's layout
} SphereView;

bool sphere_view_open(SphereView *view, Error *error);
void sphere_view_close(SphereView *view);

// Allocates memory for the model's spheres.
bool sphere_view_load(SphereView *view, const Model *model, Error *error);

void sphere_view_draw(SphereView *view, const Model *model, const Lens *lens, const Tone *tone);

// Boxes, or their diagonals, in one color.
typedef struct {
    Drawing drawing;
    bool is_diagonal;
    uint32_t count; // of loaded boxes
} LineView;

// With is_diagonal, the view draws lines from `low` to `high`. Either may be larger.
bool line_view_open(LineView *view, bool is_diagonal, Error *error);

void line_view_load(LineView *view, const Box *boxes, size_t count);
void line_view_draw(const LineView *view, const Lens *lens, const float color[3]);

// Boxes and lines for LineView: Bvh -> the boxes at one of its levels; Model -> its normals.
typedef ARRAY(Box) Boxes;

// Returns the number of levels of inner nodes.
uint32_t boxes_levels(const Bvh *bvh);

// Fills an empty array with the boxes of a level: 0 for the leaves, 1 for the root, and higher
// levels for deeper inner nodes. The caller frees the boxes, also after a failure.
bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t level, Error *error);
void boxes_free(Boxes *boxes);

// Fills an empty array with the normals of a model, as lines from low to high in the normalized
// frame. The lines start at the vertices of smooth objects, and at the centers of the triangles of
// other objects. The caller frees the array, also after a failure.
bool normals_make(Boxes *lines, const Model *model, Error *error);

// Draws a canvas with OpenGL: the latest traced picture, covered by the finished tiles of the next
// picture.

// OpenGL's copy of a layer.
typedef struct {
    GLuint texture;
    uint64_t pass, tiles;
} LayerCopy;

typedef struct {
    Drawing drawing;
    LayerCopy copies[CANVAS_LAYERS];
} RayView;

bool ray_view_open(RayView *view, Error *error);
void ray_view_close(RayView *view);

// Draws the canvas over the whole target, which has width x height pixels.
void ray_view_draw(RayView *view, Canvas *canvas, uint32_t width, uint32_t height);

// An offscreen picture, larger than the window if anti-aliased. The window's own buffer would lose
// pixels that other windows cover.
typedef struct {
    GLuint frames[2];       // the drawn framebuffer, and the displayed framebuffer
    GLuint buffers[3];      // color and depth of frames[0], color of frames[1]
    uint32_t width, height; // size of the displayed frame
    uint32_t factor;        // ratio of the drawn frame's sides to the displayed frame's sides
} Target;

void target_open(Target *target);
void target_close(Target *target);

// Begins a picture of width x height pixels, with factor x factor samples per pixel.
bool target_begin(Target *target, uint32_t width, uint32_t height, uint32_t factor, Error *error);

// Finishes the picture and copies it to the window's buffer.
void target_show(const Target *target);

// Reads the displayed picture into a new framebuffer, with colors from 0 to 1.
bool target_read(const Target *target, Framebuffer *framebuffer, Error *error);

// Text over the picture, on a translucent background: a line at the top and a panel below it.

#define FONT_CHARACTERS 95 // from the blank to the tilde

typedef struct {
    File file;                       // empty without a font
    float advances[FONT_CHARACTERS]; // widths at size 1
    GLuint texture;                  // the characters; its upper left texel is opaque
    int side;                        // of the texture, in pixels
    float size;                      // of the texture's characters, in pixels; 0 without any
    stbtt_bakedchar glyphs[FONT_CHARACTERS];
} Font;

typedef struct {
    float x, y, u, v, color[4];
} TextVertex;

typedef struct {
    Drawing drawing;
    Font font;
    ARRAY(TextVertex) corners; // of the text to draw
} TextView;

// The texts of a frame. The view shortens the line.
typedef struct {
    char *line;             // loses phrases after commas until it fits the window
    const char *panel;      // made smaller to fit the window; two blanks start a second column
    uint32_t width, height; // of the window in pixels
    float density;          // pixels per 1/96 inch
} TextOverlay;

// Without a font, succeeds, stores a message in no_font, and makes the view draw nothing.
bool text_view_open(TextView *view, Error *no_font, Error *error);
void text_view_close(TextView *view);

void text_view_draw(TextView *view, const TextOverlay *overlay);
