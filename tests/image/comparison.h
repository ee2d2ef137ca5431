// SPDX-License-Identifier: MIT
// Counts pixels that differ from the oracle's picture, by the reason that the oracle gives.
#pragma once

#include "oracle/oracle.h"

// A pixel differs if the difference of a channel is larger than this.
#define COLOR_TOLERANCE (1.0f / 255)

// Returns the largest difference of a channel.
static inline float color_difference(const float a[3], const float b[3])
{
    return fmaxf(fabsf(a[0] - b[0]), fmaxf(fabsf(a[1] - b[1]), fabsf(a[2] - b[2])));
}

typedef struct {
    uint32_t compared;                                       // number of compared pixels
    uint32_t differing;                                      // number of differing pixels
    uint32_t at_edges, at_creases, at_horizons, unexplained; // by explanation
    float largest_agreeing;      // the largest channel difference of the other pixels
    uint32_t x, y;               // of the first unexplained pixel
    float color[3], expected[3]; // the colors of that pixel
} Comparison;

// Compares every step-th pixel of every step-th row of picture. expected contains only these
// pixels.
Comparison comparison_make(const OracleView *view, const Framebuffer *picture,
                           const Framebuffer *expected, uint32_t step);

// Prints the figures in one line that starts with name.
void comparison_print(const Comparison *comparison, const char *name);

// Returns the allowed number of differing pixels, rounded up. `limit` is the number that is allowed
// if 512 x 512 pixels are compared.
uint32_t comparison_allowance(const Comparison *comparison, uint32_t limit);
