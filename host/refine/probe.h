// SPDX-License-Identifier: MIT
// The grid of places in a pixel, and requests for samples at thin parts.
//
// A pixel is covered by scan lines along one axis. A line is the middle of a band. Level 0 has
// three bands, and each further level divides a band into three. A band of the last level is as
// high as a place.
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

// Requests a sample in a pixel. Lines are rows or columns, depending on the pixel.
typedef struct {
    uint32_t pixel;
    uint8_t line;  // middle of a band of the level
    uint8_t place; // on the line
    uint8_t level;
} Probe;
