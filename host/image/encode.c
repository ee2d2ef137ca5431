// SPDX-License-Identifier: MIT
// Colors as floats -> bytes. Rounds to the nearest byte, because truncation would double the
// largest error.
#include "image/image_file.h"

#include <math.h>

static double srgb_curve(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

void encode_channels(const float *values, size_t count, Encoding encoding, double gain,
                     unsigned char *bytes)
{
    const float factor = (float)gain;
    for (size_t i = 0; i < count; i++) {
        const double value = (double)(values[i] * factor < 1 ? values[i] * factor : 1);
        const double shown = encoding == ENCODE_SRGB ? srgb_curve(value) : value;
        bytes[i] = (unsigned char)(shown * 255 + 0.5);
    }
}

unsigned char *encode_bytes(const Framebuffer *framebuffer, const ImageSettings *settings,
                            Error *error)
{
    const size_t count = (size_t)framebuffer->width * framebuffer->height;
    unsigned char *bytes = memory_raw(count, 3, error);
    if (bytes != NULL)
        encode_channels(framebuffer->pixels[0], 3 * count, settings->encoding,
                        exp2(settings->exposure), bytes);
    return bytes;
}
