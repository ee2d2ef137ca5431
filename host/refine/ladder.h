// SPDX-License-Identifier: MIT
// Refines a picture for error and time goals. Each pixel climbs a ladder of samples. Rung 0 is the
// pixel's center, and the next rungs are 4, 8, 16 ... 1024 points of the pixel's sequence. Similar
// pixels of a rung form a stratum. Statistics of the stratum determine how many of its pixels
// advance, and hashes of their positions select these pixels.
//
// An error goal needs an honest estimate of the error. A pixel's own samples estimate its error
// badly: samples that all miss a detail agree with each other. Therefore some pixels of each kind
// advance even if they look finished. Their changes of color measure the errors of the pixels that
// stay (ladder_strata.h).
//
// First, ladder_entry.c places all pixels on rung 0. In each round, ladder_choice.c selects pixels,
// and ladder.c traces the samples of these pixels and assigns the pixels to new strata.
//
// Invariant: with an error goal, choices depend only on sums of samples, and sums are added in a
// fixed order. The picture therefore depends neither on the order of work nor on the device.
#pragma once

#include "refine/ladder_state.h"

// The largest width and height of a picture. Sub-pixel positions then fit into 31 bits.
#define LADDER_SIDE_MOST   (1u << 19)
#define LADDER_PIXELS_MOST ((uint64_t)1 << 31)

// Makes a ladder with one sample per pixel. Fails if the picture exceeds LADDER_SIDE_MOST or
// LADDER_PIXELS_MOST.
bool ladder_open(Ladder *ladder, const RefineSetup *setup, Error *error);
void ladder_close(Ladder *ladder);

// Returns the number of samples taken in a pixel.
uint32_t ladder_pixel_samples(const Ladder *ladder, size_t pixel);

// An error goal, or a time budget on the clock of clock_seconds.
typedef struct {
    double error;          // largest bound; ignored if there is a time budget
    double start, seconds; // the time budget; there is none if `seconds` is 0
} Goal;

// The root mean square error of the picture's values, before they are rounded for a file.
typedef struct {
    double estimate;
    double bound; // the error is lower with 95 % confidence
    bool reached; // the error goal was met; with a time budget: time was left at the start
} GoalOutcome;

// Refines until outcome->bound is at most goal->error, or until about goal->seconds have passed
// since goal->start. Stops earlier if no pixel can advance, if too many rounds have passed, or if
// the observer stops the trace.
bool ladder_refine(Ladder *ladder, const Goal *goal, GoalOutcome *outcome, Error *error);
