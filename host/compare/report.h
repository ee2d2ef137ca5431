// SPDX-License-Identifier: MIT
// The comparison of two pictures as text and JSON.
#pragma once

#include "compare/difference.h"

#include <stdio.h>

typedef struct {
    ComparedImages compared;
    Difference difference;
    Causes causes;
    const Limits *limits;
} Comparison;

// Returns whether the difference is within all limits.
bool comparison_is_kept(const Comparison *comparison);

void comparison_write_text(const Comparison *comparison, FILE *stream);

// Writes versioned JSON with sorted keys to path ("-": standard output).
bool comparison_write_json(const Comparison *comparison, const char *path, Error *error);
