/* SPDX-License-Identifier: MIT */
/* The C face of the module that holds OpenImageIO: C++ stays behind it. */
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
    int left, top, whole_width, whole_height; /* where that lies in a whole picture; 0: is whole */
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

#define IMAGE_MODULE_CHANNELS  64
#define IMAGE_MODULE_NAME_SIZE 32
#define IMAGE_MODULE_TEXTS     8
#define IMAGE_MODULE_TEXT_SIZE 512

/* What a file holds. */
typedef struct {
    uint64_t values_max;           /* larger pictures are refused */
    const char *const *text_names; /* of the texts that are wanted */
    uint32_t width, height, channel_count;
    int is_8_bit;
    char names[IMAGE_MODULE_CHANNELS][IMAGE_MODULE_NAME_SIZE];
    char texts[IMAGE_MODULE_TEXTS][IMAGE_MODULE_TEXT_SIZE];
    void *values; /* unsigned char or float, all channels of a pixel together, top row first */
} ImageModuleContent;

/* Reads the file of OpenImageIO's format; 0 and a message where it cannot.  The values stay for as
   long as the process, which reads nothing else. */
typedef int ImageModuleRead(const char *path, const char *format, ImageModuleContent *content,
                            char *message, size_t message_size);
#define IMAGE_MODULE_READ "clrt_image_module_read"
ImageModuleRead clrt_image_module_read;

#ifdef __cplusplus
}
#endif
