// SPDX-License-Identifier: MIT
// Parses decimal numbers with correct rounding, independently of the locale.
#pragma once

#include <stdint.h>

// Parses the decimal number that starts at `text`: an optional sign, digits with an optional point,
// and an optional exponent. Reads no byte at or after `end`. Hexadecimal numbers, "inf" and "nan"
// are not accepted. Returns the end of the number, or NULL if no number starts at `text`. A value
// beyond the range of double becomes an infinity, which the caller must reject.
const char *number_parse(const char *text, const char *end, double *value);

// Parses a decimal integer with an optional sign. Returns the integer's end. Returns NULL if no
// integer starts at `text`, or if the integer does not fit in int64_t.
const char *integer_parse(const char *text, const char *end, int64_t *value);
