// SPDX-License-Identifier: MIT
// Each round raises the fractions of some strata and advances the pixels that these fractions
// select.
#include "refine/ladder.h"

#include "base/clock.h"

#include <math.h>

// After this many rounds, clrt gives up the error goal.
#define ROUNDS_MOST 300

// A round should take at most PART_OF_ROUND of the remaining time, or all of it if less than
// PART_OF_LAST of the budget remains. If less than PART_UNSPENT remains, no further round starts.
#define PART_OF_ROUND 0.5
#define PART_OF_LAST  0.2
#define PART_UNSPENT  0.03

// With a time budget, a round aims at this fraction of the current bound of the mean square error.
#define FALL_OF_ROUND 0.25

static void describe(const Ladder *ladder, GoalOutcome *outcome)
{
    const StrataEstimate estimate = strata_estimate(&ladder->statistics);
    outcome->estimate = sqrt(estimate.mean);
    outcome->bound = sqrt(estimate.bound);
}

bool goal_reach_error(Ladder *ladder, double most, GoalOutcome *outcome, Error *error)
{
    const StrataAim aim = {.mean_square = most * most, .samples = INFINITY};
    bool ok = true, moves = true;
    *outcome = (GoalOutcome){0};
    for (int round = 0;
         ok && moves && round < ROUNDS_MOST && pixel_requests_are_whole(&ladder->requests);
         round++) {
        uint64_t advanced;
        const StrataOutcome raised = strata_raise(&ladder->statistics, &aim);
        outcome->reached = raised == STRATA_REACHED;
        if (outcome->reached)
            break;
        ok = ladder_advance(ladder, &advanced, error);
        moves = raised == STRATA_RAISED || advanced > 0;
    }
    describe(ladder, outcome);
    return ok;
}

// Returns the number of samples that fit into the next round, at the previous round's speed.
static double samples_in_time(const GoalTime *time, double seconds_per_sample)
{
    const double left = time->seconds - (clock_seconds() - time->start);
    if (left < PART_UNSPENT * time->seconds)
        return 0;
    return (left < PART_OF_LAST * time->seconds ? 1 : PART_OF_ROUND) * left / seconds_per_sample;
}

bool goal_spend_time(Ladder *ladder, const GoalTime *time, GoalOutcome *outcome, Error *error)
{
    double moment = clock_seconds();
    double seconds_per_sample = (moment - time->start) / (double)ladder->samples;
    uint64_t advanced = 1;
    bool ok = true;
    *outcome = (GoalOutcome){.reached = moment - time->start < time->seconds};
    while (ok && pixel_requests_are_whole(&ladder->requests)) {
        const StrataEstimate estimate = strata_estimate(&ladder->statistics);
        const StrataAim aim = {FALL_OF_ROUND * estimate.bound,
                               samples_in_time(time, seconds_per_sample)};
        const uint64_t before = ladder->samples;
        if (aim.samples < ladder_samples[1] ||
            (strata_raise(&ladder->statistics, &aim) == STRATA_EXHAUSTED && advanced == 0))
            break;
        ok = ladder_advance(ladder, &advanced, error);
        const double now = clock_seconds();
        if (ladder->samples > before)
            seconds_per_sample = (now - moment) / (double)(ladder->samples - before);
        moment = now;
    }
    describe(ladder, outcome);
    return ok;
}
