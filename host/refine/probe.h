// SPDX-License-Identifier: MIT
// A pixel's grid of places, which are square cells, and requests for samples at thin parts.
//
// A pixel is covered by parallel bands, and the middle of a band is a scan line. Level 0 has three
// bands, and each further level divides each band into three. A band of the last level is as high
// as a place.
#pragma once

#include <stdint.h>

#define REFINE_GRID   81 // places along a pixel's side
#define REFINE_LEVELS 4
#define FIRST_SAMPLES 8 // of a refined pixel's first three lines, without the pixel's center

// Returns the height of a level's bands, in places.
static inline uint32_t band_height(uint32_t level)
{
    static const uint32_t heights[REFINE_LEVELS] = {27, 9, 3, 1};
    return heights[level];
}

// A request for a sample in a pixel. The lines of a pixel are either rows or columns.
typedef struct {
    uint32_t pixel;
    uint8_t line;  // the middle of a band
    uint8_t place; // on the line
    uint8_t level;
} Probe;
