/* SPDX-License-Identifier: MIT */
/* The C face of the module that holds OpenImageIO: C++ stays behind it. */
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define IMAGE_MODULE_LAYERS 64

typedef struct {
    const char *path;
    const char *format; /* OpenImageIO's name of the format */
    const void *pixels; /* width * height * 3 of unsigned char or float, top row first */
    int width, height;
    int is_float;
    const char *const *texts; /* text_count pairs of name and value */
    size_t text_count;
    const void *layers; /* layer_count values of 32 bits for each pixel, of float pictures alone */
    size_t layer_count;
    const char *layer_names[IMAGE_MODULE_LAYERS];
    int layer_is_integer[IMAGE_MODULE_LAYERS]; /* unsigned; else float */
} ImageModulePicture;

/* Writes the picture; 0 and a message of at most message_size bytes where it cannot. */
typedef int ImageModuleWrite(const ImageModulePicture *picture, char *message, size_t message_size);
#define IMAGE_MODULE_WRITE "clrt_image_module_write"
ImageModuleWrite clrt_image_module_write;

#ifdef __cplusplus
}
#endif
