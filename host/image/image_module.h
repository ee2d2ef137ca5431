/* SPDX-License-Identifier: MIT */
/* The C interface of the module that contains OpenImageIO and all C++. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define IMAGE_MODULE_LAYERS 64

typedef struct {
    const char *path;
    const char *format; /* OpenImageIO's name of the format */
    const void *pixels; /* width * height * 3 of unsigned char or float, top row first */
    int width, height;
    int tile_width, tile_height; /* of the tiles in an EXR file */
    int is_part;                 /* pixels and layers contain only these tiles, below each other: */
    const uint32_t *tiles;       /* tile_count positions in the picture, each X and Y */
    size_t tile_count;
    int frames; /* of an animation, below each other; 0: one picture */
    int left, top, whole_width, whole_height; /* of a crop; whole_width is 0 without one */
    int is_float;
    const char *const *texts; /* text_count pairs of name and value */
    size_t text_count;
    const void *layers; /* layer_count 32-bit values per pixel; float pictures only */
    size_t layer_count;
    const char *layer_names[IMAGE_MODULE_LAYERS];
    int layer_is_integer[IMAGE_MODULE_LAYERS]; /* nonzero: unsigned integers; 0: floats */
} ImageModulePicture;

/* Writes the picture. Returns 0 on failure, with the reason in message. */
typedef int ImageModuleWrite(const ImageModulePicture *picture, char *message, size_t message_size);
#define IMAGE_MODULE_WRITE "clrt_image_module_write"
ImageModuleWrite clrt_image_module_write;

#define IMAGE_MODULE_CHANNELS  64
#define IMAGE_MODULE_NAME_SIZE 32
#define IMAGE_MODULE_TEXTS     8
#define IMAGE_MODULE_TEXT_SIZE 512

/* A picture file's contents, and the limits for reading it. */
typedef struct {
    uint64_t values_max;           /* input: the largest width * height * channel_count */
    const char *const *text_names; /* input: names of the requested texts */
    uint32_t width, height, channel_count;
    int is_8_bit;
    char names[IMAGE_MODULE_CHANNELS][IMAGE_MODULE_NAME_SIZE];
    char texts[IMAGE_MODULE_TEXTS][IMAGE_MODULE_TEXT_SIZE];
    void *values; /* unsigned char or float, all channels of a pixel together, top row first */
} ImageModuleContent;

/* Reads a file in this OpenImageIO format. Returns 0 on failure, with the reason in message. The
   values are never freed, because the process reads only one file. */
typedef int ImageModuleRead(const char *path, const char *format, ImageModuleContent *content,
                            char *message, size_t message_size);
#define IMAGE_MODULE_READ "clrt_image_module_read"
ImageModuleRead clrt_image_module_read;

#ifdef __cplusplus
}
#endif
