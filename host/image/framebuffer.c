// SPDX-License-Identifier: MIT
// Allocates and frees pictures and their channels, and computes a picture's hash.
#include "image/framebuffer.h"

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
