// SPDX-License-Identifier: MIT
// Numbers in text, read the same in every locale and rounded correctly.
#pragma once

#include <stdbool.h>
#include <stdint.h>

// Parses one decimal number (sign, digits, point, exponent; no hex, no "inf", no "nan") at text,
// which ends before end.  Returns where it stopped, or NULL when no number starts there.  A value
// past the range of double comes back as an infinity, for the caller to refuse.
const char *number_parse(const char *text, const char *end, double *value);

// The same for a decimal integer with an optional sign; NULL also where it leaves int64_t.
const char *integer_parse(const char *text, const char *end, int64_t *value);
