// SPDX-License-Identifier: MIT
// Refines a picture until it is as near as asked, or until as much time is spent.
#pragma once

#include "render/adaptive.h"

// How it ended.
typedef struct {
    double estimate; // of the error, root mean square over all values, with a margin
    float threshold; // the last
    bool reached;
} GoalOutcome;

// Refines until the estimate is at most that, from strong contrasts to weak ones: not at all where
// one sample a pixel does.
bool goal_reach_error(Adaptive *adaptive, double most, const RenderObserver *observer,
                      GoalOutcome *outcome, Error *error);

// By clock_seconds.
typedef struct {
    double start, seconds;
} GoalTime;

// Refines until so many seconds have passed since the start.
bool goal_spend_time(Adaptive *adaptive, const GoalTime *time, const RenderObserver *observer,
                     GoalOutcome *outcome, Error *error);
