// SPDX-License-Identifier: MIT
// The text of an option's value -> the value.  Each returns false, or -1, where it is not
// understood, with a sentence that names the option.
#pragma once

#include "base/error.h"

#include <stdint.h>

// An integer from 1 to highest.
bool read_count(const char *value, const char *option, int64_t highest, uint32_t *count,
                Error *error);

// A number above 0 and up to 1.
bool read_part(const char *value, const char *option, double *part, Error *error);

// "WxH", each from 1 to highest.
bool read_area(const char *value, const char *option, int64_t highest, uint32_t area[2],
               Error *error);

// Finds value among the count names and returns its place, -1 where it is none.
int read_choice(const char *value, const char *option, const char *const *names, int count,
                Error *error);
