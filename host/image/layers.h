// SPDX-License-Identifier: MIT
// The channels of a picture other than its colors. Each value has 32 bits and is a float or an
// unsigned integer.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef struct {
    const char *name; // the channel's name in the file; borrowed
    bool is_integer;
} LayerType;

#define LAYERS_MOST 64

typedef struct {
    LayerType list[LAYERS_MOST];
    uint32_t count;
    uint32_t width, height;
    uint32_t *values; // width * height * count values, top row first; floats are stored as their
                      // bits; owned
} Layers;

// Allocates zeros as the values. The caller has set list and count.
bool layers_make(Layers *layers, uint32_t width, uint32_t height, Error *error);
void layers_free(Layers *layers);

// Returns the values of a pixel.
static inline uint32_t *layers_at(const Layers *layers, uint32_t x, uint32_t y)
{
    return layers->values + ((size_t)y * layers->width + x) * layers->count;
}
