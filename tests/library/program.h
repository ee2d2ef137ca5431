// SPDX-License-Identifier: MIT
// Compares pictures of the library with pictures of the program clrt.
#pragma once

#include <clrt.h>

// Runs clrt with the scene file and the options. Returns the picture: 3 * width * height floats,
// the top row first. The caller frees it.
float *program_draw(const char *scene, const char *options, uint32_t width, uint32_t height);

// Reads a PFM file of this size. The caller frees the floats.
float *program_read(const char *path, uint32_t width, uint32_t height);

// Returns whether the library draws the expected picture, bit for bit.
bool program_agrees(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtPicture *picture,
                    const float *expected);

// Opens a renderer for the device that CLRT_DEVICE names. Returns NULL on failure.
ClrtRenderer *program_renderer(uint32_t threads);

// Returns the path of a file of the source tree.
const char *program_file(const char *name);
