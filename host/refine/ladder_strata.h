// SPDX-License-Identifier: MIT
// Estimates a picture's error by stratified sampling of its pixels (Cochran, "Sampling techniques",
// 1977). A pixel on rung i has the mean color of ladder_samples[i] samples. Similar pixels of a
// rung form a stratum. Hashes select the pixels of a stratum that advance to the next rung. These
// pixels are controls: their changes estimate the errors of the pixels that stay.
//
// Invariant: the pixels of a stratum that advance are chosen by their positions alone, never by
// their colors. The controls are therefore a random sample of the stratum.
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

// Samples of a pixel on each rung: the center, or the first points of the pixel's sequence.
#define LADDER_RUNGS 10
static const uint32_t ladder_samples[LADDER_RUNGS] = {1, 4, 8, 16, 32, 64, 128, 256, 512, 1024};

// On rung 0, strata are octaves of the pixel's bend (refine/ladder_entry.c). Each octave from
// FLAT_CLASS on has a second stratum, for pixels near contrast. The second strata are numbered from
// NEAR_CLASS on. From octave FLAT_CLASS on, a pixel that a thin part touches (refine/thin_parts.h)
// is in THIN_CLASS instead. On higher rungs, strata are octaves of the standard deviation of a
// pixel's samples. Each octave has a stratum for each BentClass, because a few samples may miss an
// edge that the bend shows.
#define FLAT_CLASS        4
#define NEAR_CLASS        8
#define THIN_CLASS        12
#define BEND_CLASSES      13
#define DEVIATION_CLASSES 7
#define STRATA_COUNT      (BEND_CLASSES + (LADDER_RUNGS - 1) * BENT_CLASSES * DEVIATION_CLASSES)

// The size of a pixel's bend on rung 0.
typedef enum { BENT_LITTLE, BENT_SOME, BENT_MUCH, BENT_CLASSES } BentClass;

// A change is the mean square difference between a pixel's colors before and after it advances. A
// feature is the squared bend on rung 0, and the variance of the mean on higher rungs. Features are
// roughly proportional to the squared errors of pixels.
typedef struct {
    uint64_t entered, advanced; // total numbers of pixels
    double feature;             // sum over the pixels that entered
    double advanced_feature;    // sum over the pixels that advanced
    double change, square;      // sums over controls: estimated squared error, and its square
    double fraction;            // part of the stratum's pixels that should advance, in [0, 1]
} Stratum;

typedef struct {
    Stratum strata[STRATA_COUNT];
    uint64_t pixels;
    double reflectivity; // the largest of the scene's surfaces; 0 if pictures show no reflections
} Strata;

// The mean square error of a picture.
typedef struct {
    double mean;  // expected
    double bound; // upper bound with 95 % confidence
} StrataEstimate;

// Returns the rung of a stratum.
static inline uint32_t strata_rung(uint32_t stratum)
{
    return stratum < BEND_CLASSES
               ? 0
               : 1 + (stratum - BEND_CLASSES) / (BENT_CLASSES * DEVIATION_CLASSES);
}

// A pixel is near contrast if a nearby pixel has a bend of at least CONTRAST.
#define CONTRAST 0.125f

// Returns the octave of a value. Octave 0 has values of at least 1/2, octave 1 values from 1/4 to
// 1/2, and so on. The last octave, classes - 1, has all smaller values. The value must not be
// negative. The function uses the value's exponent, so loops have no branches.
static inline uint32_t strata_octave(float value, uint32_t classes)
{
    int32_t bits, number, last = (int32_t)classes - 1;
    memcpy(&bits, &value, sizeof bits);
    number = 126 - (bits >> 23);
    number = number > 0 ? number : 0;
    return (uint32_t)(number < last ? number : last);
}

// Returns the stratum of a pixel on rung 0. `nearby` is the largest bend around the pixel
// (refine/ladder_entry.c), and `is_thin` is true if a thin part touches the pixel. The function is
// inline, because it runs for every pixel of a picture.
static inline uint32_t strata_of_bend(float bend, float nearby, bool is_thin)
{
    const uint32_t number = strata_octave(bend, NEAR_CLASS);
    const uint32_t is_flat = number >= FLAT_CLASS, is_near = nearby >= CONTRAST;
    if (is_thin && is_flat)
        return THIN_CLASS;
    return number + (is_flat & is_near) * (NEAR_CLASS - FLAT_CLASS);
}

// Returns the stratum of a pixel above rung 0 from the standard deviation of its samples.
uint32_t strata_of_deviation(uint32_t rung, double deviation, BentClass bent);

// Returns the class that a pixel of the stratum has on the next rung. Uses `bend` only for strata
// of rung 0.
BentClass strata_bent_class(uint32_t stratum, double bend);

// Records that pixels enter a stratum. `features` is the sum of the pixels' features.
void strata_enter(Strata *strata, uint32_t stratum, uint64_t pixels, double features);

// Records that a pixel advances from a stratum.
void strata_advance(Strata *strata, uint32_t stratum, double feature, double change);

StrataEstimate strata_estimate(const Strata *strata);

// The aim of a round of advances.
typedef struct {
    double mean_square; // upper limit for StrataEstimate::bound
    double samples;     // approximate limit for the round's samples; may be INFINITY
} StrataAim;

typedef enum {
    STRATA_REACHED,  // the bound meets the aim
    STRATA_RAISED,   // fractions have grown
    STRATA_EXHAUSTED // no stratum can advance more pixels
} StrataOutcome;

// Raises fractions so that the bound approaches the aim. First raises the fractions of strata that
// lack controls. Then raises the fractions of strata in which each sample lowers the bound most.
StrataOutcome strata_raise(Strata *strata, const StrataAim *aim);
