// SPDX-License-Identifier: MIT
// A seam is the place where colors change abruptly along a line of samples, for example between two
// surfaces. Bisection locates a seam with one sample for each bit of its position. Subdividing
// cells takes eight samples for 1.6 bits.
//
// A seam begins as a gap between two different samples of a line. If a sample in the middle of the
// gap resembles one end, it replaces this end, and the gap is halved. If the sample resembles
// neither end, another surface is between the ends, and the seam is split into two. When the
// remaining error is small enough, the colors of the line's cells are corrected as if the change
// were in the middle of the remaining gap.
//
// Invariant: the sample at `low` resembles the first end, and the sample at `high` resembles the
// last end. The change is therefore between them.
#pragma once

#include "scene/scene.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

// The tree of cells (refine_tree.h): its groups and its levels.
#define GROUP_SIDE   3
#define GROUP_CELLS  9
#define GROUP_MIDDLE 4

#define REFINE_LEVELS 4  // the deepest level; pixels have level 0
#define REFINE_GRID   81 // cells of the last level along a pixel's side

typedef enum { SEAM_END_FIRST, SEAM_END_LAST, SEAM_ENDS } SeamEnd;

// A line crosses the three cells of a row or a column of a group. Positions along the line are in
// cells of the last level.
typedef struct {
    SampleData ends[SEAM_ENDS]; // the samples at `from` and at `to`
    uint32_t x, y;              // start of the line
    uint32_t next;              // next seam of the group; 0 at the end
    uint8_t stride;             // from cell to cell: 1 along a row, GROUP_SIDE along a column
    uint8_t side;               // of each cell
    uint8_t line;               // index in the group, 0 to 2
    uint8_t from, to;           // the interval to which the seam applies
    uint8_t low, high;          // positions of the nearest samples before and after the seam
    uint8_t assumed;            // the end whose sample is beyond the line, or SEAM_ENDS if neither
    uint8_t samples;            // taken to locate the seam
} Seam;

// Returns the largest difference between two samples' color values.
static inline float seam_difference(const SampleData *one, const SampleData *other)
{
    float most = 0;
    for (int channel = 0; channel < 3; channel++) {
        const float difference = fabsf(one->color[channel] - other->color[channel]);
        most = difference > most ? difference : most;
    }
    return most;
}

// Returns the remaining error: contrast times the uncertain fraction of the pixel.
float seam_contrast(const Seam *seam);

// Returns whether another sample may narrow the interval, and stores the sample's place.
bool seam_asks(const Seam *seam, uint32_t place[2]);

// Updates the seam with the requested sample. If the sample resembles neither end, splits the seam
// and returns true. The caller must then add *rest as the next seam.
bool seam_take(Seam *seam, const SampleData *sample, Seam *rest);

// Colors in steps of 2^-32, multiplied by twice the cell's area.
typedef uint64_t ColorSum[3];

// Adds a seam's corrections to the color sums of a group's cells. Before the first correction, each
// cell's sum must be its sample's color times twice its area.
void seam_correct(const Seam *seam, const SampleData cells[], ColorSum sums[]);

static inline uint64_t seam_color_steps(float color)
{
    return (uint64_t)(color * 0x1p32f);
}
