/* SPDX-License-Identifier: MIT */
/* The C interface of the module that holds OpenImageIO and all C++. */
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
    int left, top, whole_width, whole_height; /* position in a whole picture; 0: it is whole */
    int is_float;
    const char *const *texts; /* text_count pairs of name and value */
    size_t text_count;
    const void *layers; /* layer_count 32-bit values per pixel; float pictures only */
    size_t layer_count;
    const char *layer_names[IMAGE_MODULE_LAYERS];
    int layer_is_integer[IMAGE_MODULE_LAYERS]; /* unsigned; else float */
} ImageModulePicture;

/* Writes the picture. Returns 0 on failure, with a message of at most message_size bytes. */
typedef int ImageModuleWrite(const ImageModulePicture *picture, char *message, size_t message_size);
#define IMAGE_MODULE_WRITE "clrt_image_module_write"
ImageModuleWrite clrt_image_module_write;

#define IMAGE_MODULE_CHANNELS  64
#define IMAGE_MODULE_NAME_SIZE 32
#define IMAGE_MODULE_TEXTS     8
#define IMAGE_MODULE_TEXT_SIZE 512

/* The contents of a file. */
typedef struct {
    uint64_t values_max;           /* larger pictures are rejected */
    const char *const *text_names; /* of the requested texts */
    uint32_t width, height, channel_count;
    int is_8_bit;
    char names[IMAGE_MODULE_CHANNELS][IMAGE_MODULE_NAME_SIZE];
    char texts[IMAGE_MODULE_TEXTS][IMAGE_MODULE_TEXT_SIZE];
    void *values; /* unsigned char or float, all channels of a pixel together, top row first */
} ImageModuleContent;

/* Reads a file in the given OpenImageIO format. Returns 0 on failure, with a message. The values
   live as long as the process, which reads nothing else. */
typedef int ImageModuleRead(const char *path, const char *format, ImageModuleContent *content,
                            char *message, size_t message_size);
#define IMAGE_MODULE_READ "clrt_image_module_read"
ImageModuleRead clrt_image_module_read;

#ifdef __cplusplus
}
#endif
