// SPDX-License-Identifier: MIT
// Converts float colors to the bytes of 8-bit files.
#pragma once

#include "image/image_file.h"

// Rounds count values to the nearest of 256 steps. ENCODE_SRGB applies the sRGB curve (IEC
// 61966-2-1) first.
void encode_channels(const float *values, size_t count, Encoding encoding, unsigned char *bytes);

// Encodes a whole picture as width * height * 3 bytes. The caller frees them; NULL if memory runs
// out.
unsigned char *encode_bytes(const Framebuffer *framebuffer, Encoding encoding, Error *error);
