// SPDX-License-Identifier: MIT
// A line of samples crosses from one surface to another somewhere between two of them.  Halving
// the stretch between tells where, with a sample a bit, where cutting cells takes eight for 1.6.
#pragma once

#include "scene/scene.h"

#include <math.h>
#include <stdbool.h>

#define GROUP_SIDE  3
#define GROUP_CELLS 9

typedef enum { SEAM_END_FIRST, SEAM_END_LAST, SEAM_ENDS } SeamEnd;

// Lines lie in a group, or are of one cell where they lie in a pixel.  Places are in cells of the
// last level, along the line.
typedef struct {
    SampleData ends[SEAM_ENDS]; // what is seen at `from` and at `to`
    uint32_t x, y;              // where the line begins
    uint32_t group, next;       // the group's next, or the pixel's; 0 at the end
    uint8_t stride;             // from cell to cell: 1 along a row, GROUP_SIDE along a column
    uint8_t cells, side;        // of the line, and of each
    uint8_t line;               // of the group: 0 to 2
    uint8_t from, to;           // the stretch that it tells of
    uint8_t low, high;          // samples that it lies between
    uint8_t assumed;            // the end, at the border, that was seen beyond it; or SEAM_ENDS
    uint8_t samples;            // that were taken to place it
} Seam;

// The samples of a line: its cells between what lies beyond its ends.
#define LINE_SAMPLES (GROUP_SIDE + 2)
#define LINE_GAPS    (LINE_SAMPLES - 1)

// Whether colors step in a gap of a line, rather than slope.
bool seam_steps(const SampleData *const line[LINE_SAMPLES], uint32_t gap);

// The largest difference of two samples' colors.
static inline float seam_difference(const SampleData *one, const SampleData *other)
{
    float most = 0;
    for (int channel = 0; channel < 3; channel++) {
        const float difference = fabsf(one->color[channel] - other->color[channel]);
        most = difference > most ? difference : most;
    }
    return most;
}

// The error, as contrast times the part of a pixel, that the place leaves.
float seam_contrast(const Seam *seam);

// Whether a sample can tell more; then where in the picture.
bool seam_asks(const Seam *seam, uint32_t place[2]);

// Takes that sample up.  Returns whether it saw a third surface: then `rest` is the next seam of
// the group, and has its next.
bool seam_take(Seam *seam, const SampleData *sample, Seam *rest);

// Ends the search.
void seam_close(Seam *seam);

// Colors in steps of 2^-32, times twice a cell's area.
typedef uint64_t ColorSum[3];

// Corrects the sums of a group's cells, or of a pixel, each of which was taken to be of one color.
void seam_correct(const Seam *seam, const SampleData cells[], ColorSum sums[]);

static inline uint64_t seam_color_steps(float color)
{
    return (uint64_t)(color * 0x1p32f);
}
