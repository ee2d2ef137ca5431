// SPDX-License-Identifier: MIT
// Writes the result of a comparison as text and as JSON.
#pragma once

#include "compare/difference.h"

#include <stdio.h>

typedef enum {
    CAUSE_PRIMITIVE,  // the rays through the center hit different primitives
    CAUSE_SHADOW,     // different lights reach the hit point
    CAUSE_TRUNCATION, // one picture's --max-level ends its reflections sooner
    CAUSE_REFLECTION, // the reflections differ for another reason
    CAUSE_COVERAGE,   // the pictures have different samples there
    CAUSE_ROUNDING,   // none of these: rounding, if both show the same scene
    CAUSE_KINDS
} CauseKind;

typedef struct {
    bool known;                   // both files have the required channels
    double squares[CAUSE_KINDS];  // each cause's part of the mean square error
    uint64_t pixels[CAUSE_KINDS]; // pixels that differ at all, by cause
} Causes;

// Splits the error of a pair that image_pair_check has accepted.
void causes_find(Causes *causes, const ImagePair *pair);

// The causes' names and meanings, as reports print them.
extern const char *const cause_names[CAUSE_KINDS], *const cause_meanings[CAUSE_KINDS];

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
