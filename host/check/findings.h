// SPDX-License-Identifier: MIT
// What a check measured -> what there is to say about it, each with whether it fails the check.
#pragma once

#include "check/census.h"
#include "check/leaks.h"

#define FINDING_SCENE SIZE_MAX // in place of an object: the scene as a whole

// Everything a check has measured.
typedef struct {
    const Scene *scene;
    const Census *census;
    const Normalization *normalization;
    const LeakCount *leaks;   // by object; NULL without a device
    const char *frame_fault;  // why the scene cannot be drawn, empty where it can
    const char *device_name;  // that traced the rays; NULL without one
    const char *device_fault; // why there is none
    double seconds;
} CheckResult;

typedef struct {
    const char *kind; // a name for programs
    size_t object;
    bool fails;
    size_t count; // of things found; 1 for advice
    char text[320];
} Finding;

typedef struct {
    ARRAY(Finding) list;
} Findings;

bool findings_make(Findings *findings, const CheckResult *result, Error *error);
void findings_free(Findings *findings);

size_t findings_count_failing(const Findings *findings);
