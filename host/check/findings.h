// SPDX-License-Identifier: MIT
// Measurements of a check -> findings -> text and JSON. A finding says whether it fails the check.
#pragma once

#include "check/census.h"
#include "check/leaks.h"

#include <stdio.h>

#define FINDING_SCENE SIZE_MAX // the object index of findings about the whole scene

// All measurements of a check.
typedef struct {
    const Scene *scene;
    const Census *census;
    const Normalization *normalization;
    const LeakCount *leaks;   // by object; NULL without a device
    const char *frame_fault;  // why the scene cannot be drawn; empty if it can
    const char *device_name;  // the device that traced the rays; NULL without one
    const char *device_fault; // why there is no device
    double seconds;
} CheckResult;

typedef struct {
    const char *kind; // identifier in JSON
    size_t object;
    bool fails;
    size_t count; // of occurrences; 1 for advice
    char text[320];
} Finding;

typedef struct {
    ARRAY(Finding) list;
} Findings;

bool findings_make(Findings *findings, const CheckResult *result, Error *error);
void findings_free(Findings *findings);

size_t findings_count_failing(const Findings *findings);

typedef struct {
    const char *scene_path;
    const CheckResult *result;
    const Findings *findings;
} CheckReport;

void check_report_write_text(const CheckReport *report, FILE *stream);

// Writes versioned JSON with sorted keys to path ("-": standard output).
bool check_report_write_json(const CheckReport *report, const char *path, Error *error);
