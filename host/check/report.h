// SPDX-License-Identifier: MIT
// Measurements and findings of a check -> text and JSON.
#pragma once

#include "check/findings.h"

#include <stdio.h>

typedef struct {
    const char *scene_path;
    const CheckResult *result;
    const Findings *findings;
} CheckReport;

void check_report_write_text(const CheckReport *report, FILE *stream);

// Writes versioned JSON with sorted keys to path ("-": standard output).
bool check_report_write_json(const CheckReport *report, const char *path, Error *error);
