// SPDX-License-Identifier: MIT
// Converts colors from floats to bytes by rounding. Truncation would double the largest error.
#include "image/encode.h"

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
