// SPDX-License-Identifier: MIT
// Parses numbers in text, correctly rounded and independent of the locale.
#pragma once

#include <stdint.h>

// Parses one decimal number (sign, digits, point, exponent; no hex, no "inf", no "nan") at text,
// before end. Returns the end of the number, or NULL if none starts at text. A value beyond the
// range of double becomes an infinity, which the caller must reject.
const char *number_parse(const char *text, const char *end, double *value);

// Parses a decimal integer with an optional sign. Returns NULL also if the number exceeds int64_t.
const char *integer_parse(const char *text, const char *end, int64_t *value);
