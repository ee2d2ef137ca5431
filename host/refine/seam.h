// SPDX-License-Identifier: MIT
// A seam is the place where a line of samples crosses from one surface to another. Bisection
// locates it with one sample per bit; subdividing cells takes eight samples for 1.6 bits.
#pragma once

#include "scene/scene.h"

#include <math.h>
#include <stdbool.h>

#define GROUP_SIDE  3
#define GROUP_CELLS 9

typedef enum { SEAM_END_FIRST, SEAM_END_LAST, SEAM_ENDS } SeamEnd;

// A line crosses three cells of a group, or one pixel. Positions along the line are in cells of the
// last level.
typedef struct {
    SampleData ends[SEAM_ENDS]; // the samples at from and at to
    uint32_t x, y;              // start of the line
    uint32_t group, next;       // next seam of the group or pixel; 0 at the end
    uint8_t stride;             // between indices of adjacent cells: 1 along a row, GROUP_SIDE
                                // along a column
    uint8_t cells, side;        // the number of cells on the line, and the side of each cell
    uint8_t line;               // index in the group, 0 to 2
    uint8_t from, to;           // the interval to which the seam applies
    uint8_t low, high;          // positions of the nearest samples before and after the seam
    uint8_t assumed;            // the end that uses a sample from beyond the line; SEAM_ENDS for
                                // neither
    uint8_t samples;            // taken to locate the seam
} Seam;

// The samples of a line: its cells, and one beyond each end.
#define LINE_SAMPLES (GROUP_SIDE + 2)
#define LINE_GAPS    (LINE_SAMPLES - 1)

// Returns whether colors change abruptly in a gap between two samples of a line.
bool seam_steps(const SampleData *const line[LINE_SAMPLES], uint32_t gap);

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

// Returns whether another sample would narrow the interval, and where to take it.
bool seam_asks(const Seam *seam, uint32_t place[2]);

// Updates the seam with the requested sample. Returns whether the sample sees a third surface. In
// that case, the caller must add *rest as the next seam.
bool seam_take(Seam *seam, const SampleData *sample, Seam *rest);

// Discards the seam, which then corrects nothing.
void seam_close(Seam *seam);

// Colors in steps of 2^-32, multiplied by twice the cell's area.
typedef uint64_t ColorSum[3];

// Corrects the color sums of a group's cells, or of a pixel. Before, the sums must assume one color
// per cell.
void seam_correct(const Seam *seam, const SampleData cells[], ColorSum sums[]);

static inline uint64_t seam_color_steps(float color)
{
    return (uint64_t)(color * 0x1p32f);
}
