// SPDX-License-Identifier: MIT
// The program's picture of a scene, to compare the library's with.
#pragma once

#include <clrt.h>

// Draws the scene file with those options and reads what it wrote: 3 * width * height floats, the
// top row first, that the caller frees.
float *program_draw(const char *scene, const char *options, uint32_t width, uint32_t height);

// Whether the library draws that, bit for bit.
bool program_agrees(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtPicture *picture,
                    const float *expected);

// The path of a file in the checkout.
const char *program_file(const char *name);
