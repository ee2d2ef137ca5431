// SPDX-License-Identifier: MIT
// The C interface of a helper that reads the course's reference pictures with OpenImageIO.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int width, height;
    float *pixels; // room for width * height * 3, the top row first
} ExrPicture;

// Reads the pixels of the file at path. Returns 0 and a message of at most message_size bytes if
// the file is unreadable or has another size.
int read_exr(const char *path, const ExrPicture *picture, char *message, size_t message_size);

#ifdef __cplusplus
}
#endif
