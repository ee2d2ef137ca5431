// SPDX-License-Identifier: MIT
// A picture's channels beside its colors, with values of 32 bits: floats or unsigned integers.
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
    uint32_t *values; // height * width * count, top row first, floats as their bits; owned
} Layers;

// Allocates the values, all zero, of the layers already listed.
bool layers_make(Layers *layers, uint32_t width, uint32_t height, Error *error);
void layers_free(Layers *layers);

// Returns the values of a pixel.
static inline uint32_t *layers_at(const Layers *layers, uint32_t x, uint32_t y)
{
    return layers->values + ((size_t)y * layers->width + x) * layers->count;
}
