// SPDX-License-Identifier: MIT
// Float colors -> the bytes of 8-bit files.
#pragma once

#include "image/image_file.h"

// Rounds count values to the nearest of 256 steps, after the sRGB curve (IEC 61966-2-1) where the
// encoding asks for it.
void encode_channels(const float *values, size_t count, Encoding encoding, unsigned char *bytes);

// The same of a whole picture.  The caller frees the width * height * 3 bytes; NULL when memory ran
// out.
unsigned char *encode_bytes(const Framebuffer *framebuffer, Encoding encoding, Error *error);
