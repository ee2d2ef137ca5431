// SPDX-License-Identifier: MIT
// A picture as its file stores it: named channels of floats, where 8 bits v are v / 255.
#pragma once

#include "base/array.h"

#include <stdint.h>

#define STORED_NAME_SIZE 32
#define STORED_TEXT_SIZE 512

// What is read at most.  The values are 4 GiB.
#define STORED_SIDE_MAX     65536
#define STORED_CHANNELS_MAX 64
#define STORED_VALUES_MAX   ((uint64_t)1 << 30)

// The texts that clrt's own pictures carry; stored_text_names has their names in files.
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
    char names[STORED_CHANNELS_MAX][STORED_NAME_SIZE]; // "R", "G", "B" and others; of gray, "Y"
    char texts[STORED_TEXTS][STORED_TEXT_SIZE];        // each empty where there is none
    float *values; // all channels of a pixel together, the top row first; owned
} StoredImage;

void stored_image_free(StoredImage *image);

// Whether a picture of that size is read.
bool stored_image_check_size(uint64_t width, uint64_t height, uint64_t channels, Error *cause);

// Makes the values of an image whose size and channel count are set.
bool stored_image_allocate(StoredImage *image, Error *cause);

// Place of the channel of that name, -1 where there is none.
int stored_image_channel(const StoredImage *image, const char *name);

// Places of red, green and blue, all three the same of a gray picture; false where they are not
// there.
bool stored_image_colors(const StoredImage *image, uint32_t places[3]);

// 8 bits a channel -> the values of a file.
void stored_image_values(const unsigned char *bytes, size_t count, float *values);
