// SPDX-License-Identifier: MIT
// Advances the pixels of a ladder until the picture meets an error goal, or until a time budget is
// spent.
#pragma once

#include "refine/ladder.h"

// The root mean square error of the picture's values, before they are rounded for a file.
typedef struct {
    double estimate;
    double bound; // the error is lower with 95 % confidence
    bool reached;
} GoalOutcome;

// Refines until the bound is at most `most`, or until no further samples would lower it.
bool goal_reach_error(Ladder *ladder, double most, GoalOutcome *outcome, Error *error);

// A time budget, on the clock of clock_seconds.
typedef struct {
    double start, seconds;
} GoalTime;

// Refines until time->seconds have passed since the start.
bool goal_spend_time(Ladder *ladder, const GoalTime *time, GoalOutcome *outcome, Error *error);
