// SPDX-License-Identifier: MIT
// Pixels that have advanced from a stratum are its controls (ladder_strata.h defines the other
// terms). The estimate for a stratum is a weighted mean of its controls' errors and a prior. The
// prior is the mean feature of the stratum's pixels, times the rung's ratio of squared errors to
// features. Pixels that look flat may hide detail that no sample hit. The feature in a prior
// therefore has a minimum. The minimum is larger near contrast, because most hidden detail was
// found there. With one minimum for all strata, errors reached 1.3 times the goal on tiled floors.
#include "refine/ladder_strata.h"

#include <math.h>

// A pixel is in BENT_SOME if its bend (ladder_entry.c) exceeds SOME_BEND, or if a thin part touches
// it. It is in BENT_MUCH if its bend exceeds LARGE_BEND.
#define SOME_BEND  0.05
#define LARGE_BEND 0.5

// Weights of the priors, in pixels. With a STRATUM_WEIGHT of 1, more than 5 % of the errors in a
// test exceeded their bounds.
#define RUNG_WEIGHT    4
#define STRATUM_WEIGHT 1.3

// The change per feature on rungs 0 and 1 before any change is measured.
#define CENTER_RATIO 0.03
#define FIRST_RATIO  0.5

// The least feature in a prior, as a fraction of the rung's largest mean feature. On rung 0,
// THIN_CLASS has LEAST_THIN, strata near contrast have LEAST_NEAR, and all others have LEAST_FAR.
// Rung 1 has LEAST_SAMPLED. Detail that n samples missed covers about 1/n of a pixel, so the
// fraction falls from rung to rung. With a constant fraction, the estimates rose again above 64
// samples.
#define LEAST_THIN    1
#define LEAST_NEAR    0.3
#define LEAST_FAR     0.05
#define LEAST_SAMPLED 0.05

// A mirror may show detail that is nowhere else in the picture. The detail's contrast is at most
// the mirror's reflectivity. Instead of LEAST_FAR and LEAST_SAMPLED, it therefore gets the
// following values times the squared reflectivity, if these are larger (docs/accuracy.md).
#define LEAST_FAR_MIRROR     0.2
#define LEAST_SAMPLED_MIRROR 0.1

// The minimum of a rung's largest mean feature is EDGE_CENTER on rung 0, and EDGE_SAMPLED /
// ladder_samples[i] on a higher rung i. Without this minimum, the bound would be 0 if all pixel
// centers miss the objects.
#define EDGE_CENTER  0.75
#define EDGE_SAMPLED 0.0625

// On rung 0, a pixel that advances drops its old sample, so the change is the sum of the squared
// errors before and after. Let twice as many samples divide the squared error by D. The change is
// then the squared error before, times 1 + 1 / D^2. With the values of D in the next comment,
// factors of 0.89 and 0.8 would correct the change.
#define CENTER_FACTOR 0.85

// Above rung 0, a pixel that advances keeps its old samples, so the change underestimates the
// squared error. Let twice as many samples divide the squared error by D. The change is then the
// squared error before, times 1 - 1 / D. D is 2.83 at edges and 2 for noise, so factors of 1.55 and
// 2 would correct the change. In twelve generated scenes, the squared error was 1.45 to 1.61 times
// the change on rungs 1 to 5, and 1.7 times on rung 6.
#define NESTED_FACTOR 1.6

// A step raises the fraction of a stratum's pixels that advance. A stratum's first step selects the
// number of controls at which the prior contributes PRIOR_PART of the aim to the estimate. This
// number is limited to between FIRST_LEAST and FIRST_MOST of the stratum's pixels, but is at least
// FIRST_PIXELS.
#define PRIOR_PART   0.03
#define FIRST_LEAST  (1.0 / 128)
#define FIRST_MOST   (1.0 / 32)
#define FIRST_PIXELS 32

// Each step after the first multiplies the fraction by this factor.
#define FRACTION_GROWTH 4

// A stratum without controls must advance some pixels if it is on rung 0, or if its expected error
// exceeds this fraction of the aim.
#define FORCED_PART 0.02

// A round takes steps until the sum of their gains is COVERED_PART of the excess. The excess is the
// bound minus the aim. A gain includes only GAIN_PART of the errors of advancing pixels. Steps that
// score below SCORE_PART of the best score wait for a later round. The last step is shortened to
// the missing gain, but not below STEP_PART of its size. A limit on samples may shorten this step
// further.
#define COVERED_PART 0.8
#define SCORE_PART   0.3
#define GAIN_PART    0.85
#define STEP_PART    0.2

// A normal distribution's values are below its mean plus this many standard deviations with a
// probability of 95 %.
#define DEVIATIONS 1.645

// Statistics shared by all strata of a rung.
typedef struct {
    double ratio;   // change per feature
    double feature; // largest mean feature of a stratum, but at least the rung's minimum
} Rung;

// The forecast for one stratum.
typedef struct {
    double left;           // pixels that have not advanced
    double mean, variance; // of their squared errors
} Outlook;

// The forecast for all strata, and its sums over the picture.
typedef struct {
    Outlook strata[STRATA_COUNT];
    double mean, variance; // of the sum of all squared errors
} Forecast;

uint32_t strata_of_deviation(uint32_t rung, double deviation, BentClass bent)
{
    return BEND_CLASSES + (BENT_CLASSES * (rung - 1) + bent) * DEVIATION_CLASSES +
           strata_octave((float)deviation, DEVIATION_CLASSES);
}

BentClass strata_bent_class(uint32_t stratum, double bend)
{
    if (stratum >= BEND_CLASSES)
        return (stratum - BEND_CLASSES) / DEVIATION_CLASSES % BENT_CLASSES;
    if (bend > LARGE_BEND)
        return BENT_MUCH;
    return bend > SOME_BEND || stratum == THIN_CLASS ? BENT_SOME : BENT_LITTLE;
}

void strata_enter(Strata *strata, uint32_t stratum, uint64_t pixels, double features)
{
    strata->strata[stratum].entered += pixels;
    strata->strata[stratum].feature += features;
}

void strata_advance(Strata *strata, uint32_t stratum, double feature, double change)
{
    Stratum *left = &strata->strata[stratum];
    const double error = (strata_rung(stratum) > 0 ? NESTED_FACTOR : CENTER_FACTOR) * change;
    left->advanced++;
    left->advanced_feature += feature;
    left->change += error;
    left->square += error * error;
}

static double mean_feature(const Stratum *stratum)
{
    return stratum->entered > 0 ? stratum->feature / (double)stratum->entered : 0;
}

// Returns the ratio of change to feature that is expected before any pixel advances. Features
// shrink like the squared error of independent samples. The squared error of Sobol points shrinks
// faster, so the ratio falls from rung to rung. A rung has twice as many samples as the one below.
static double first_ratio(const Rung rungs[], uint32_t rung)
{
    if (rung < 2)
        return rung == 0 ? CENTER_RATIO : FIRST_RATIO;
    return rungs[rung - 1].ratio / sqrt(2);
}

// Computes the statistics of a rung. Requires the statistics of the lower rungs.
static void measure_rung(Rung rungs[], uint32_t rung, const Strata *strata)
{
    const double first = first_ratio(rungs, rung);
    double feature = 0, change = 0;
    double largest = (rung == 0 ? EDGE_CENTER : EDGE_SAMPLED) / ladder_samples[rung];
    for (uint32_t i = 0; i < STRATA_COUNT; i++) {
        const Stratum *stratum = &strata->strata[i];
        if (strata_rung(i) != rung)
            continue;
        feature += stratum->advanced_feature;
        change += stratum->change;
        largest = fmax(largest, mean_feature(stratum));
    }
    const double weight = RUNG_WEIGHT * largest;
    rungs[rung] = (Rung){(change + weight * first) / (feature + weight), largest};
}

static double least_feature(uint32_t stratum, double reflectivity)
{
    const double square = reflectivity * reflectivity;
    if (stratum >= BEND_CLASSES)
        return fmax(LEAST_SAMPLED, LEAST_SAMPLED_MIRROR * square) * ladder_samples[1] /
               ladder_samples[strata_rung(stratum)];
    if (stratum == THIN_CLASS)
        return LEAST_THIN;
    return stratum >= NEAR_CLASS ? LEAST_NEAR : fmax(LEAST_FAR, LEAST_FAR_MIRROR * square);
}

static Outlook outlook_of(const Strata *strata, uint32_t number, const Rung *rung)
{
    const Stratum *stratum = &strata->strata[number];
    const double least = least_feature(number, strata->reflectivity) * rung->feature;
    const double feature = fmax(mean_feature(stratum), least);
    const double prior = rung->ratio * feature;
    const double weight = (double)stratum->advanced + STRATUM_WEIGHT;
    const double mean = (stratum->change + STRATUM_WEIGHT * prior) / weight;
    const double square =
        (stratum->square + STRATUM_WEIGHT * STRATUM_WEIGHT * 2 * prior * prior) / weight;
    return (Outlook){.left = (double)(stratum->entered - stratum->advanced),
                     .mean = mean,
                     .variance = fmax(square - mean * mean, 0.1 * mean * mean)};
}

// Returns the variance of a stratum's sum of squared errors after `more` additional pixels have
// advanced.
static double variance_after(const Stratum *stratum, const Outlook *outlook, double more)
{
    const double left = outlook->left - more;
    return left * left * outlook->variance / ((double)stratum->advanced + more + STRATUM_WEIGHT);
}

static Forecast forecast_of(const Strata *strata)
{
    Forecast forecast = {.mean = 0};
    Rung rungs[LADDER_RUNGS];
    for (uint32_t rung = 0; rung < LADDER_RUNGS; rung++)
        measure_rung(rungs, rung, strata);
    for (uint32_t i = 0; i < STRATA_COUNT; i++) {
        Outlook *outlook = &forecast.strata[i];
        *outlook = outlook_of(strata, i, &rungs[strata_rung(i)]);
        forecast.mean += outlook->left * outlook->mean;
        forecast.variance += variance_after(&strata->strata[i], outlook, 0);
    }
    return forecast;
}

static double bound_of(const Forecast *forecast)
{
    return forecast->mean + DEVIATIONS * sqrt(forecast->variance);
}

StrataEstimate strata_estimate(const Strata *strata)
{
    const Forecast forecast = forecast_of(strata);
    const double pixels = (double)strata->pixels;
    return (StrataEstimate){forecast.mean / pixels, bound_of(&forecast) / pixels};
}

// A possible increase of a stratum's fraction.
typedef struct {
    uint32_t stratum;
    double fraction; // after the step
    double pixels;   // expected to advance
    double gain;     // decrease of the bound
    double score;    // gain per sample
    bool is_forced;
} Step;

static double step_cost(uint32_t stratum)
{
    const uint32_t rung = strata_rung(stratum);
    return rung == 0 ? ladder_samples[1] : ladder_samples[rung + 1] - ladder_samples[rung];
}

// Returns the fraction of a stratum that its first step selects.
static double first_fraction(const Stratum *stratum, const Outlook *outlook, double aim)
{
    const double pixels = STRATUM_WEIGHT * outlook->left * outlook->mean / (PRIOR_PART * aim);
    const double entered = (double)stratum->entered;
    return fmax(fmin(fmax(pixels / entered, FIRST_LEAST), FIRST_MOST), FIRST_PIXELS / entered);
}

// Computes the next step of a stratum. Returns false if no more pixels can advance. The step
// selects the stratum's first controls, or multiplies its fraction by FRACTION_GROWTH.
static bool next_step(Step *step, uint32_t number, const Strata *strata, const Forecast *forecast,
                      double aim)
{
    const Stratum *stratum = &strata->strata[number];
    const Outlook *outlook = &forecast->strata[number];
    const uint32_t rung = strata_rung(number);
    if (rung + 1 == LADDER_RUNGS || outlook->left < 1 || stratum->fraction >= 1)
        return false;
    const double now = stratum->fraction;
    const double wanted =
        now == 0 ? first_fraction(stratum, outlook, aim) : fmax(FIRST_MOST, FRACTION_GROWTH * now);
    const double fraction = fmin(wanted, 1), pixels = outlook->left * (fraction - now) / (1 - now);
    const double variance = forecast->variance - variance_after(stratum, outlook, 0) +
                            variance_after(stratum, outlook, pixels);
    const double gain = GAIN_PART * pixels * outlook->mean +
                        DEVIATIONS * (sqrt(forecast->variance) - sqrt(fmax(variance, 0)));
    const bool is_forced =
        now == 0 && (rung == 0 || outlook->left * outlook->mean > FORCED_PART * aim);
    *step = (Step){number, fraction, pixels, gain, gain / (pixels * step_cost(number)), is_forced};
    return true;
}

// Returns the index of the remaining step with the best score, or `count` if no step remains.
static uint32_t best_step(const Step *steps, uint32_t count)
{
    uint32_t best = count;
    for (uint32_t i = 0; i < count; i++)
        if (steps[i].score > 0 && (best == count || steps[i].score > steps[best].score))
            best = i;
    return best;
}

// Takes the steps, highest score first. Stops when the steps cover the missing gain, when the
// samples are used up, or when the remaining scores are low.
static void take_steps(Strata *strata, Step *steps, uint32_t count, double missing, double samples)
{
    double good = 0;
    for (;;) {
        const uint32_t place = best_step(steps, count);
        if (place == count || missing <= 0 || samples <= 0 || steps[place].score < good)
            return;
        const Step *step = &steps[place];
        const double cost = step->pixels * step_cost(step->stratum);
        const double part = fmin(fmax(missing / step->gain, STEP_PART), samples / cost);
        Stratum *stratum = &strata->strata[step->stratum];
        stratum->fraction += fmin(part, 1) * (step->fraction - stratum->fraction);
        missing -= step->gain;
        samples -= cost;
        good = fmax(good, SCORE_PART * step->score);
        steps[place].score = 0;
    }
}

// Returns whether the bound meets the aim even if the errors of strata without controls are twice
// as large as expected. On rung 0, all strata need controls.
static bool is_reached(const Strata *strata, const Forecast *forecast, double aim)
{
    double unknown = 0;
    for (uint32_t i = 0; i < STRATA_COUNT; i++) {
        const Outlook *outlook = &forecast->strata[i];
        if (strata->strata[i].fraction > 0 || outlook->left < 1)
            continue;
        if (strata_rung(i) == 0)
            return false;
        unknown += outlook->left * outlook->mean;
    }
    return bound_of(forecast) + unknown <= aim;
}

StrataOutcome strata_raise(Strata *strata, const StrataAim *aim)
{
    Step steps[STRATA_COUNT];
    uint32_t count = 0;
    const Forecast forecast = forecast_of(strata);
    const double wanted = aim->mean_square * (double)strata->pixels;
    const double excess = bound_of(&forecast) - wanted;
    double samples = aim->samples;
    bool is_forced = false;
    if (is_reached(strata, &forecast, wanted))
        return STRATA_REACHED;
    for (uint32_t i = 0; i < STRATA_COUNT; i++) {
        const Step *step = &steps[count];
        if (!next_step(&steps[count], i, strata, &forecast, wanted))
            continue;
        count += !step->is_forced;
        if (step->is_forced) {
            is_forced = true;
            strata->strata[i].fraction = step->fraction;
            samples -= step->pixels * step_cost(i);
        }
    }
    take_steps(strata, steps, count, COVERED_PART * excess, samples);
    if (!is_forced && excess <= 0)
        return STRATA_REACHED;
    return is_forced || count > 0 ? STRATA_RAISED : STRATA_EXHAUSTED;
}
