// SPDX-License-Identifier: MIT
// Pictures for tests, and files for their scenes. A picture that cannot be drawn and a file that
// cannot be written fail the test.
#pragma once

#include "image/picture.h"
#include "mesh/mesh.h"

#include <stdio.h>

// Ends the test with the error's text unless ok.
void rendered_require(bool ok, const Error *error);

// Reads a scene file. The caller frees the scene.
Scene rendered_scene(const char *path);

// The caller frees the picture.
Framebuffer rendered(const PictureRequest *request);

// Also draws the listed channels. The caller frees layers.
Framebuffer rendered_with(PictureRequest request, const char *channels, Layers *layers);

// Returns the request for one of form_all.
PictureRequest rendered_in_form(PictureRequest request, const KernelChoice *form);

// Returns the floats that a channel of floats stores.
double layer_float(uint32_t bits);
Vec3 layer_vector(const uint32_t bits[3]);

// Fails the test unless all others, count of them, are the same bits as the expected picture.
void rendered_expect_same(const PictureRequest *expected, const PictureRequest *others,
                          size_t count);

// The same for one picture in every form in fp32, with other threads, trees and programs.
void rendered_expect_same_in_every_form(const PictureRequest *usual);

// The root mean square difference of the values of two pictures of one size.
double rendered_error(const Framebuffer *one, const Framebuffer *other);

#define TEMPORARY_PATH 64

// Opens a new file for writing in /tmp and stores its path. The caller removes the file.
FILE *temporary_open(char path[TEMPORARY_PATH]);
void temporary_close(FILE *stream);

// Writes the mesh to a new PLY file and stores its path. The caller removes the file.
void temporary_mesh(char path[TEMPORARY_PATH], const Mesh *mesh);
