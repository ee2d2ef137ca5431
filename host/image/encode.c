// SPDX-License-Identifier: MIT
// Rounds where the course truncates, which halves the error.
#include "image/encode.h"

#include <math.h>

static double srgb_curve(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

unsigned char *encode_bytes(const Framebuffer *framebuffer, Encoding encoding, Error *error)
{
    const size_t count = (size_t)framebuffer->width * framebuffer->height;
    unsigned char *bytes = memory_raw(count, 3, error);
    if (bytes == NULL)
        return NULL;
    for (size_t pixel = 0; pixel < count; pixel++)
        for (int channel = 0; channel < 3; channel++) {
            const double value = (double)framebuffer->pixels[pixel][channel];
            const double shown = encoding == ENCODE_SRGB ? srgb_curve(value) : value;
            bytes[3 * pixel + (size_t)channel] = (unsigned char)(shown * 255 + 0.5);
        }
    return bytes;
}
