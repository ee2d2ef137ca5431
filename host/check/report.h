// SPDX-License-Identifier: MIT
// The findings of a check as text and JSON.
#pragma once

#include "check/findings.h"

#include <stdio.h>

void check_report_write_text(const Check *check, FILE *stream);

// Writes versioned JSON with sorted keys to path ("-": standard output).
bool check_report_write_json(const Check *check, const char *path, Error *error);
