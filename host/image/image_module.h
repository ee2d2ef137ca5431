/* SPDX-License-Identifier: MIT */
/* The C face of the module that holds OpenImageIO: C++ stays behind it. */
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    const char *path;
    const char *format; /* OpenImageIO's name of the format */
    const void *pixels; /* width * height * 3 of unsigned char or float, top row first */
    int width, height;
    int is_float;
    const char *const *texts; /* text_count pairs of name and value */
    size_t text_count;
} ImageModulePicture;

/* Writes the picture; 0 and a message of at most message_size bytes where it cannot. */
typedef int ImageModuleWrite(const ImageModulePicture *picture, char *message, size_t message_size);
#define IMAGE_MODULE_WRITE "clrt_image_module_write"
ImageModuleWrite clrt_image_module_write;

#ifdef __cplusplus
}
#endif
