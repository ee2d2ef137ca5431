// SPDX-License-Identifier: MIT
// Converts traced colors to the bytes of 8-bit files and of the window.
#pragma once

#include <stddef.h>

typedef enum { ENCODE_RAW, ENCODE_SRGB } Encoding;

// Multiplies `count` values by gain, limits them to 1 and rounds them to bytes.
// ENCODE_SRGB applies the sRGB curve (IEC 61966-2-1) before rounding.
void encode_channels(const float *values, size_t count, Encoding encoding, double gain,
                     unsigned char *bytes);
