// SPDX-License-Identifier: MIT
// A picture read from a file: named channels of floats or of 32-bit ids.
#pragma once

#include "base/array.h"

#include <stdint.h>

#define STORED_NAME_SIZE 32
#define STORED_TEXT_SIZE 512

// image_read rejects pictures beyond these limits. A picture's values take at most 4 GiB. A hostile
// file of some kilobytes could claim to contain gigabytes. A file of more than STORED_VALUES_LEAST
// values must therefore have at least one byte for every STORED_VALUES_PER_BYTE values.
#define STORED_SIDE_MAX        65536
#define STORED_CHANNELS_MAX    64
#define STORED_VALUES_MAX      ((uint64_t)1 << 30)
#define STORED_VALUES_LEAST    ((uint64_t)100000000)
#define STORED_VALUES_PER_BYTE 256

// The texts that clrt stores in picture files. stored_text_names holds the name of each text.
typedef enum {
    STORED_VERSION,
    STORED_SCENE_HASH,
    STORED_MESH_HASH,
    STORED_SETTINGS,
    STORED_DEVICE,
    STORED_DRIVER,
    STORED_PIXEL_HASH,
    STORED_COMPLETE,
    STORED_TEXTS
} StoredText;

extern const char *const stored_text_names[STORED_TEXTS];

typedef struct {
    uint32_t width, height, channel_count;
    char names[STORED_CHANNELS_MAX][STORED_NAME_SIZE]; // "R", "G", "B" and others; "Y" for gray
    char texts[STORED_TEXTS][STORED_TEXT_SIZE];        // empty if missing
    float *values; // pixel by pixel, each with all its channels; top row first; owned
} StoredImage;

void stored_image_free(StoredImage *image);

// Returns the largest number of values that clrt accepts from a file of `bytes` bytes.
uint64_t stored_values_most(uint64_t bytes);

// Returns whether the image's size is within the limits above and has at most `most` values.
bool stored_image_check_size(const StoredImage *image, uint64_t most, Error *cause);

// Allocates the values of an image whose size and channel count are set and checked.
bool stored_image_allocate(StoredImage *image, Error *cause);

// Returns the index of the channel with this name, or -1 if there is none.
int stored_image_channel(const StoredImage *image, const char *name);

// Stores the channel indices of red, green and blue. Channel Y replaces missing colors. Returns
// false if a color is missing and there is no Y.
bool stored_image_colors(const StoredImage *image, uint32_t places[3]);

// Converts each 8-bit value v to v / 255.
void stored_image_values(const unsigned char *bytes, size_t count, float *values);
