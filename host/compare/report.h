// SPDX-License-Identifier: MIT
// Writes the result of a comparison as text and as JSON.
#pragma once

#include "compare/causes.h"
#include "compare/limits.h"

#include <stdio.h>

typedef struct {
    const ImagePair *pair;
    const Difference *difference;
    const Causes *causes;
    const Limits *limits;
} CompareReport;

// Returns whether the difference is within all limits.
bool compare_report_is_kept(const CompareReport *report);

void compare_report_write_text(const CompareReport *report, FILE *stream);

// Writes versioned JSON with sorted keys to path ("-": standard output).
bool compare_report_write_json(const CompareReport *report, const char *path, Error *error);
