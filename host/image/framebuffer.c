// SPDX-License-Identifier: MIT
// Allocates and frees pictures and their channels, computes a picture's hash, and converts colors
// from floats to bytes by rounding. Truncation would double the largest error.
#include "image/framebuffer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <xxhash.h>

bool framebuffer_make(Framebuffer *framebuffer, uint32_t width, uint32_t height, Error *error)
{
    *framebuffer = (Framebuffer){.width = width, .height = height};
    framebuffer->pixels = memory_zeroed((size_t)width * height, sizeof *framebuffer->pixels, error);
    return framebuffer->pixels != NULL;
}

void framebuffer_free(Framebuffer *framebuffer)
{
    free(framebuffer->pixels);
    *framebuffer = (Framebuffer){0};
}

void framebuffer_hash(const Framebuffer *framebuffer, char hash[FRAMEBUFFER_HASH_SIZE])
{
    const size_t count = (size_t)framebuffer->width * framebuffer->height;
    const XXH128_hash_t value = XXH3_128bits_withSeed(
        framebuffer->pixels, count * sizeof *framebuffer->pixels, framebuffer->width);
    snprintf(hash, FRAMEBUFFER_HASH_SIZE, "%016llx%016llx", (unsigned long long)value.high64,
             (unsigned long long)value.low64);
}

bool layers_make(Layers *layers, uint32_t width, uint32_t height, Error *error)
{
    layers->width = width;
    layers->height = height;
    layers->values =
        memory_zeroed((size_t)width * height, layers->count * sizeof *layers->values, error);
    return layers->values != NULL;
}

void layers_free(Layers *layers)
{
    free(layers->values);
    *layers = (Layers){0};
}

static double srgb_curve(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

void framebuffer_encode(const float *values, size_t count, Encoding encoding, double gain,
                        unsigned char *bytes)
{
    const float factor = (float)gain;
    for (size_t i = 0; i < count; i++) {
        const double value = (double)(values[i] * factor < 1 ? values[i] * factor : 1);
        const double shown = encoding == ENCODE_SRGB ? srgb_curve(value) : value;
        bytes[i] = (unsigned char)(shown * 255 + 0.5);
    }
}
