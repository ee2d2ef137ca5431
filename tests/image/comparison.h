// SPDX-License-Identifier: MIT
// A picture against what it should be: how many pixels differ, and whether the oracle sees why.
#pragma once

#include "oracle/oracle.h"

// Differences up to this, in any channel, are rounding.
#define COLOR_TOLERANCE (1.0f / 255)

typedef struct {
    uint32_t compared;                                       // pixels
    uint32_t differing;                                      // by more than the tolerance
    uint32_t at_edges, at_creases, at_horizons, unexplained; // of those
    float largest_agreeing;      // difference of a channel among the pixels that do not differ
    uint32_t x, y;               // of the first unexplained pixel
    float color[3], expected[3]; // there
} Comparison;

// expected holds every step-th pixel of every step-th row of picture.
Comparison comparison_make(const OracleView *view, const Framebuffer *picture,
                           const Framebuffer *expected, uint32_t step);

// Prints the figures as one line that starts with name.
void comparison_print(const Comparison *comparison, const char *name);

// How many pixels may differ where `limit` of a 512 x 512 picture may, rounded up.
uint32_t comparison_allowance(const Comparison *comparison, uint32_t limit);
