// SPDX-License-Identifier: MIT
// The C face of a helper that reads the course's reference pictures with OpenImageIO.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Fills pixels with the width * height * 3 floats of the picture at path, the top row first.
// 0, and a message of at most message_size bytes, where it cannot or the size is another.
int read_exr(const char *path, int width, int height, float *pixels, char *message,
             size_t message_size);

#ifdef __cplusplus
}
#endif
