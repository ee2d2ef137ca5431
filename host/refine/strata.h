// SPDX-License-Identifier: MIT
// Estimates a picture's error by stratified sampling of its pixels (Cochran, "Sampling techniques",
// 1977).  A pixel's rung is its number of samples; the pixels of a rung that look alike form a
// stratum.  In every stratum, pixels chosen at random advance to the next rung.  They are its
// controls: their change estimates the error of the pixels that stay.
#pragma once

#include <stdbool.h>
#include <stdint.h>

// Samples of a pixel on each rung: its center, or that many of its sequence.
#define LADDER_RUNGS 6
static const uint32_t ladder_samples[LADDER_RUNGS] = {1, 4, 16, 64, 256, 1024};

// Strata of rung 0 are octaves of the bend; those from FLAT_CLASS on exist twice, away from
// contrast and from NEAR_CLASS on beside it.  Higher rungs have octaves of the standard deviation
// of the pixel's samples, for straight and for bent pixels.
#define FLAT_CLASS        4
#define NEAR_CLASS        8
#define BEND_CLASSES      12
#define DEVIATION_CLASSES 7
#define STRATA_COUNT      (BEND_CLASSES + (LADDER_RUNGS - 1) * 2 * DEVIATION_CLASSES)

// A change is the mean square of a pixel's color values after minus before it advanced; its feature
// is a number that its squared error is roughly proportional to.
typedef struct {
    uint64_t entered, advanced; // pixels, ever
    double feature;             // sum over the pixels that entered
    double advanced_feature;    // sum over those that advanced
    double change, square;      // sums of changes and of their squares over those that advanced
    double fraction;            // of the stratum that is to advance, in [0, 1]
} Stratum;

typedef struct {
    Stratum strata[STRATA_COUNT];
    uint64_t pixels;
} Strata;

// The mean square error of a picture.
typedef struct {
    double mean;  // expected
    double bound; // one-sided, at two standard deviations
} StrataEstimate;

// The rung of a stratum.
uint32_t strata_rung(uint32_t stratum);

// The stratum of a pixel on rung 0 by its bend and the largest one nearby (refine/bends.h).
uint32_t strata_of_bend(double bend, double nearby);

// The stratum of a pixel on a rung above 0, by the standard deviation of its samples.
uint32_t strata_of_deviation(uint32_t rung, double deviation, bool is_bent);

// Whether a pixel of the stratum counts as bent on the next rung; bend is that of a pixel on rung
// 0.
bool strata_is_bent(uint32_t stratum, double bend);

// Records that a pixel enters a stratum.
void strata_enter(Strata *strata, uint32_t stratum, double feature);

// Records that a pixel advances from a stratum.
void strata_advance(Strata *strata, uint32_t stratum, double feature, double change);

StrataEstimate strata_estimate(const Strata *strata);

// The aim of a round.
typedef struct {
    double mean_square; // error that the bound must not exceed
    double samples;     // limit of the round; INFINITY for none
} StrataAim;

typedef enum {
    STRATA_REACHED,  // the bound is within the aim
    STRATA_RAISED,   // fractions have grown
    STRATA_EXHAUSTED // no stratum has a step left
} StrataOutcome;

// Raises the fractions of the strata whose samples lower the bound most, toward the aim.
StrataOutcome strata_raise(Strata *strata, const StrataAim *aim);
