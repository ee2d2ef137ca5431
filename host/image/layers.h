// SPDX-License-Identifier: MIT
// Channels of a picture beside its colors, each of 32 bits: floats or unsigned integers.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef struct {
    const char *name; // of the channel in the file; borrowed
    bool is_integer;
} LayerType;

#define LAYERS_MOST 64

typedef struct {
    LayerType list[LAYERS_MOST];
    uint32_t count;
    uint32_t width, height;
    uint32_t *values; // height * width * count, the top row first, floats by their bits; owned
} Layers;

// Takes the memory for the layers that the list already names; all values are zero.
bool layers_make(Layers *layers, uint32_t width, uint32_t height, Error *error);
void layers_free(Layers *layers);

// The values of a pixel.
static inline uint32_t *layers_at(const Layers *layers, uint32_t x, uint32_t y)
{
    return layers->values + ((size_t)y * layers->width + x) * layers->count;
}
