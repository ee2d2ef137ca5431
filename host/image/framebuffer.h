// SPDX-License-Identifier: MIT
// A traced picture: its colors as floats, and its other channels. Colors are converted to bytes for
// 8-bit files and for the window.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef struct {
    float (*pixels)[3]; // R G B in [0, 1], width * height pixels, top row first; owned
    uint32_t width, height;
} Framebuffer;

// Makes a black picture.
bool framebuffer_make(Framebuffer *framebuffer, uint32_t width, uint32_t height, Error *error);
void framebuffer_free(Framebuffer *framebuffer);

// Writes 32 hexadecimal digits that identify the picture's size and exact bits (128-bit XXH3).
#define FRAMEBUFFER_HASH_SIZE 33
void framebuffer_hash(const Framebuffer *framebuffer, char hash[FRAMEBUFFER_HASH_SIZE]);

// The name and type of a channel. The values are floats or 32-bit unsigned integers.
typedef struct {
    const char *name; // the channel's name in the file; borrowed
    bool is_integer;
} LayerType;

#define LAYERS_MOST 64

// A picture's channels besides its colors.
typedef struct {
    LayerType list[LAYERS_MOST];
    uint32_t count;
    uint32_t width, height;
    uint32_t *values; // width * height * count integers or bits of floats, top row first; owned
} Layers;

// Allocates the values and sets them to zero. The caller must have set `list` and `count`.
bool layers_make(Layers *layers, uint32_t width, uint32_t height, Error *error);
void layers_free(Layers *layers);

typedef enum { ENCODE_RAW, ENCODE_SRGB } Encoding;

// Multiplies `count` values by `gain`, limits them to 1 and rounds them to bytes. ENCODE_SRGB
// applies the sRGB curve (IEC 61966-2-1) before rounding.
void framebuffer_encode(const float *values, size_t count, Encoding encoding, double gain,
                        unsigned char *bytes);
