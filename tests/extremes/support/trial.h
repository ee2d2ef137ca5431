// SPDX-License-Identifier: MIT
// A scene ready to be traced by clrt and, where they are here, by its peers: rays and a judgment
// become a reported case.
#pragma once

#include "report.h"

typedef struct {
    const char *test;
    RayBatch *batch;
    Peers peers;
} Trial;

// How many rays are wrong, with each program.
typedef struct {
    size_t ours;
    PeerFails peers;
} Fails;

void fails_add(Fails *sum, const Fails *more);

// Uploads the stage; the stage may be freed meanwhile.
void trial_open(Trial *trial, const char *test, RayBatch *batch, const Stage *stage);
void trial_close(Trial *trial);

// Traces the rays, reports those that the judgment calls wrong and returns how many they are.
size_t trial_judge(const Trial *trial, const char *details, const TestRay *rays, size_t count,
                   const Judgment *judgment);

// Wrong is what meets nothing, or something at no finite distance.
size_t trial_misses(const Trial *trial, const char *details, const TestRay *rays, size_t count);
extern const Judgment judgment_misses;

// Returns the counts that these would report, to be added up over several scenes.
Fails trial_fails(const Trial *trial, const TestRay *rays, size_t count, const Judgment *judgment);
size_t report_fails(const char *test, const char *details, size_t rays, const Fails *fails);
