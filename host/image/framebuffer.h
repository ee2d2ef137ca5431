// SPDX-License-Identifier: MIT
// The traced picture: shader values as floats, filled tile by tile.
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

// Writes 32 hexadecimal digits that identify the size and the exact bits of all pixels (XXH3, 128
// bits).
#define FRAMEBUFFER_HASH_SIZE 33
void framebuffer_hash(const Framebuffer *framebuffer, char hash[FRAMEBUFFER_HASH_SIZE]);
