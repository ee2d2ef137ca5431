// SPDX-License-Identifier: MIT
// Samples on scan lines -> the mean colors of pixels.
//
// A refined pixel is covered by lines along the axis on which its neighbors' colors change more.
// The lines therefore cross color edges. A line's sum is the integral of its colors, by the
// trapezoid rule over its samples. The pixel's color is the mean of these sums, weighted by the
// heights of the lines' bands. Along a straight edge, the sums change linearly from line to line,
// so three lines suffice.
//
// A gap between two samples of a line is open if their colors differ too much for the gap's length.
// Bisection locates an abrupt change with one sample for each bit of its position. When a gap is
// closed, its integral is added to the line's sum, and its samples are dropped.
//
// Invariant: a pixel's color is a sum of integers. Its bits depend on which samples exist, and not
// on the order in which the samples were taken.
#pragma once

#include "base/array.h"
#include "refine/probe.h"
#include "scene/scene.h"

#include <math.h>
#include <stdbool.h>

typedef struct {
    uint64_t sum[3];        // of colors in steps of 2^-32, times half places
    uint32_t pixel;         // index in ScanLines::pixels
    uint32_t next;          // the pixel's next line, with a larger middle; 0 at the end
    uint8_t middle, height; // of the line's band, in places
} ScanLine;

// Two neighboring samples of a line.
typedef struct {
    SampleData ends[2];
    uint32_t line;
    uint8_t from, to; // places of the ends
} Gap;

typedef struct {
    uint32_t pixel;       // index in the picture
    uint32_t lines;       // the first line
    uint32_t probes, end; // indices of the first probe and behind the last one
    uint32_t samples;     // taken in the pixel
    bool has_columns;     // lines are columns
} RefinedPixel;

typedef struct {
    const Probe *probes;        // of all pixels
    float threshold;            // largest error of a gap that needs no sample
    float bend;                 // largest error of a band that needs no further lines
    ARRAY(RefinedPixel) pixels; // from index 1
    ARRAY(ScanLine) lines;      // from index 1
    ARRAY(Gap) gaps;            // open
    uint32_t opened;            // lines from this index on have no samples yet
} ScanLines;

bool scan_lines_make(ScanLines *scan, Error *error);
void scan_lines_free(ScanLines *scan);

// Adds the first lines of a pixel: three, and more around its probes.
bool scan_lines_add(ScanLines *scan, const RefinedPixel *pixel, Error *error);

// A sample of a line.
typedef struct {
    uint32_t place;
    SampleData data;
} LineSample;

// Adds the first samples of the line scan->opened, and opens or closes the gaps between these
// samples. The samples must be in ascending order of their places.
bool scan_lines_open(ScanLines *scan, const LineSample *samples, uint32_t count, Error *error);

// Returns the place of the sample that a gap needs.
uint32_t scan_gap_place(const Gap *gap);

// Splits each open gap i by samples[i], and keeps those halves that are open.
bool scan_lines_split_gaps(ScanLines *scan, const SampleData *samples, Error *error);

// The mean color of a line. The line's place `middle` is relative to a pixel, and may be outside of
// the pixel.
typedef struct {
    int middle;
    double color[3];
} LineMean;

LineMean scan_line_mean(const ScanLine *line);

// Adds lines to a pixel where the mean colors of its lines do not change linearly. `beyond` has the
// nearest line before the pixel and the nearest line after it. All gaps must be closed.
bool scan_lines_divide(ScanLines *scan, uint32_t number, const LineMean beyond[2], Error *error);

// Closes all gaps.
void scan_lines_close_gaps(ScanLines *scan);

// Computes a pixel's mean color. All gaps must be closed. Returns false if a line has no samples.
bool scan_lines_color(const ScanLines *scan, const RefinedPixel *pixel, float color[3]);

// Returns the largest difference between two samples' color values.
static inline float sample_difference(const SampleData *one, const SampleData *other)
{
    float most = 0;
    for (int channel = 0; channel < 3; channel++) {
        const float difference = fabsf(one->color[channel] - other->color[channel]);
        most = difference > most ? difference : most;
    }
    return most;
}
