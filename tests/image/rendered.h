// SPDX-License-Identifier: MIT
// Draws pictures for tests, and writes files for their scenes. Any failure ends the test.
#pragma once

#include "image/picture.h"
#include "mesh/mesh.h"

#include <stdio.h>

// Ends the test with the error's text unless ok.
void rendered_require(bool ok, const Error *error);

// Reads a scene file. The caller frees the scene.
Scene rendered_scene(const char *path);

// Draws a picture. The caller frees it.
Framebuffer rendered(const PictureRequest *request);

// Draws a picture and the listed channels. The caller frees both.
Framebuffer rendered_with(PictureRequest request, const char *channels, Layers *layers);

// Returns the request with another form of the kernels, one of form_all.
PictureRequest rendered_in_form(PictureRequest request, const KernelChoice *form);

// Returns the values of a pixel.
static inline const uint32_t *layers_at(const Layers *layers, uint32_t x, uint32_t y)
{
    return layers->values + ((size_t)y * layers->width + x) * layers->count;
}

// Return the floats with these bits. Channels store floats as bits.
double layer_float(uint32_t bits);
Vec3 layer_vector(const uint32_t bits[3]);

// Draws `expected` and `count` other pictures. Fails the test unless all have the same bits.
void rendered_expect_same(const PictureRequest *expected, const PictureRequest *others,
                          size_t count);

// Draws a picture in every fp32 form, with varied threads, trees and specialization. Fails the test
// unless all have the same bits.
void rendered_expect_same_in_every_form(const PictureRequest *usual);

// Draws a picture with one sample per pixel in every fp32 form: with the usual tree, with another
// tree and other tiles, and without a tree. Fails the test unless all have the same bits.
void rendered_expect_same_with_every_tree(PictureRequest usual);

// Returns the root mean square difference of the values of two pictures of the same size.
double rendered_error(const Framebuffer *one, const Framebuffer *other);

#define TEMPORARY_PATH 64

// Opens a new file for writing in /tmp and stores its path. The caller removes the file.
FILE *temporary_open(char path[TEMPORARY_PATH]);
void temporary_close(FILE *stream);

// Writes the mesh to a new PLY file and stores its path. The caller removes the file.
void temporary_mesh(char path[TEMPORARY_PATH], const Mesh *mesh);
