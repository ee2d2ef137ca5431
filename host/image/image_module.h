/* SPDX-License-Identifier: MIT */
/* The C interface of the module that contains all of clrt's C++ and calls OpenImageIO. */
#pragma once

#include "image/stored_image.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    const char *path;
    const char *format; /* OpenImageIO's name of the format */
    const void *pixels; /* width * height * 3 values, unsigned char or float, top row first */
    int width, height;
    int frames; /* frames of an animation, one below the other; 0 for a single picture */
    int is_float;
    const char *const *texts; /* text_count pairs of name and value */
    size_t text_count;
} ImageModulePicture;

/* Writes the picture. Returns 0 on failure, with the reason in `message`. */
typedef int ImageModuleWrite(const ImageModulePicture *picture, char *message, size_t message_size);
#define IMAGE_MODULE_WRITE "clrt_image_module_write"
ImageModuleWrite clrt_image_module_write;

/* A picture file's contents, and the limits for reading it. */
typedef struct {
    uint64_t values_max;           /* input: the largest width * height * channel_count */
    const char *const *text_names; /* input: names of the requested texts */
    StoredImage image;             /* without values */
    int is_8_bit;
    void *values; /* unsigned char, or float (32-bit integers in channels of ids); all channels of
                    a pixel together, top row first */
} ImageModuleContent;

/* Reads a file in the OpenImageIO format `format`. Returns 0 on failure, with the reason in
   `message`. The values are never freed, because the process reads only one file. */
typedef int ImageModuleRead(const char *path, const char *format, ImageModuleContent *content,
                            char *message, size_t message_size);
#define IMAGE_MODULE_READ "clrt_image_module_read"
ImageModuleRead clrt_image_module_read;

#ifdef __cplusplus
}
#endif
