// SPDX-License-Identifier: MIT
// What a check measured and found, as text and as JSON.
#pragma once

#include "check/findings.h"

#include <stdio.h>

typedef struct {
    const char *scene_path;
    const CheckResult *result;
    const Findings *findings;
} CheckReport;

void check_report_write_text(const CheckReport *report, FILE *stream);

// Versioned JSON with sorted keys, at path ("-": standard output).
bool check_report_write_json(const CheckReport *report, const char *path, Error *error);
