// SPDX-License-Identifier: MIT
// Thresholds fall step by step, and every step takes up all samples that there are.
#include "render/goal.h"

#include "base/clock.h"
#include "render/cell_sums.h"

#include <math.h>

// What the estimate is multiplied by: measured, it is 0.9 to 1.4 of the error.
#define MARGIN 1.2

// Contrasts in this relation to the error leave about that error; the threshold starts above.
#define CONTRAST_OF_ERROR 60
#define LEAST_THRESHOLD   1e-7f
#define MOST_THRESHOLD    2 // which no contrast is above

// A step of the threshold: where details are many, errors fall with its power of 0.7.
#define FALL_MOST  0.3
#define FALL_LEAST 0.92
#define FALL_POWER 1.5

// Spending time.  Thresholds fall slowly, since cells that a pass makes may be worth more than
// others that it could afford.
#define TIME_FALL_MOST    0.25f
#define SAMPLES_THAT_TELL 10000 // how long one takes

// The part of what is left that a step may take, the part of all from which one step takes the
// rest, and the part that is not worth another.
#define PART_OF_STEP 0.5
#define PART_OF_LAST 0.2
#define PART_UNSPENT 0.03

static bool estimate(const Adaptive *adaptive, CellSums *sums, GoalOutcome *outcome, Error *error)
{
    if (!cell_sums_make(sums, adaptive, error))
        return false;
    outcome->estimate = MARGIN * cell_sums_error(sums);
    return true;
}

static float lower_threshold(float threshold, double estimate, double most)
{
    const double fall = pow(most / estimate, FALL_POWER);
    return (float)((double)threshold * fmin(fmax(fall, FALL_MOST), FALL_LEAST));
}

bool goal_reach_error(Adaptive *adaptive, double most, const RenderObserver *observer,
                      GoalOutcome *outcome, Error *error)
{
    CellSums sums;
    float threshold = (float)(CONTRAST_OF_ERROR * most);
    *outcome = (GoalOutcome){.threshold = MOST_THRESHOLD};
    if (!adaptive_has_small_parts(adaptive)) {
        if (!estimate(adaptive, &sums, outcome, error))
            return false;
        outcome->reached = outcome->estimate <= most;
    }
    while (!outcome->reached && adaptive_is_whole(adaptive) &&
           outcome->threshold >= LEAST_THRESHOLD) {
        outcome->threshold = threshold;
        if (!adaptive_refine(adaptive, threshold, observer, error) ||
            !estimate(adaptive, &sums, outcome, error))
            return false;
        outcome->reached = outcome->estimate <= most;
        threshold = lower_threshold(threshold, outcome->estimate, most);
    }
    return true;
}

// Time being spent, and what passes are known to take of it.
typedef struct {
    Adaptive *adaptive;
    const RenderObserver *observer;
    GoalTime time;
    CellSums sums;
    double of_sample; // seconds, in the latest pass
    double of_look;   // seconds of looking at all cells, which storing takes as well
} Spending;

// How many samples there is time for.
static double samples_in_time(const Spending *spending)
{
    const double seconds = spending->time.seconds;
    const double left = seconds - (clock_seconds() - spending->time.start) - spending->of_look;
    if (left < PART_UNSPENT * seconds)
        return 0;
    return (left < PART_OF_LAST * seconds ? 1 : PART_OF_STEP) * left / spending->of_sample;
}

static bool look(Spending *spending, GoalOutcome *outcome, Error *error)
{
    const double start = clock_seconds();
    const bool ok = estimate(spending->adaptive, &spending->sums, outcome, error);
    spending->of_look = clock_seconds() - start;
    return ok;
}

// Returns whether there was time for a pass, and something to do.
static bool pass_in_time(Spending *spending, GoalOutcome *outcome, Error *error)
{
    Adaptive *adaptive = spending->adaptive;
    const double affordable = samples_in_time(spending);
    const float threshold = fmaxf(cell_sums_threshold(&spending->sums, affordable),
                                  outcome->threshold * TIME_FALL_MOST);
    const double start = clock_seconds();
    const uint64_t before = adaptive->samples;
    if (affordable < ADAPTIVE_CUT || !adaptive_is_whole(adaptive) ||
        !adaptive_refine_once(adaptive, threshold, spending->observer, error))
        return false;
    const double taken = clock_seconds() - start;
    const uint64_t samples = adaptive->samples - before;
    outcome->threshold = threshold;
    if (samples > SAMPLES_THAT_TELL)
        spending->of_sample = taken / (double)samples;
    return samples > 0 || threshold > LEAST_THRESHOLD;
}

bool goal_spend_time(Adaptive *adaptive, const GoalTime *time, const RenderObserver *observer,
                     GoalOutcome *outcome, Error *error)
{
    const double passed = clock_seconds() - time->start;
    Spending spending = {.adaptive = adaptive, .observer = observer, .time = *time};
    spending.of_sample = passed / (double)adaptive->samples;
    *outcome = (GoalOutcome){.threshold = 1, .reached = passed < time->seconds};
    do {
        if (!look(&spending, outcome, error))
            return false;
    } while (pass_in_time(&spending, outcome, error));
    return error->text[0] == '\0';
}
