// SPDX-License-Identifier: MIT
// What callers hand over -> faults in words.  Below this folder the same would be our own fault and
// asserted, so everything is looked at here.
#pragma once

#include "base/error.h"
#include "library/clrt.h"

// Fills error, unless it is NULL, and returns false.
__attribute__((format(printf, 3, 4))) bool check_fail(ClrtError *error, ClrtFault fault,
                                                      const char *format, ...);

// check_fail with what a stage had to say.
bool check_fail_for(ClrtError *error, ClrtFault fault, const Error *cause);

// Each fails with CLRT_ARGUMENT; what names the argument.
bool check_given(ClrtError *error, const char *what, const void *pointer);
bool check_number(ClrtError *error, const char *what, double number, double low, double high);
bool check_vector(ClrtError *error, const char *what, const double vector[3], double most);
bool check_color(ClrtError *error, const char *what, const double color[3]);

// Copies one of the header's structs into copy, which has that size.  What an older program's
// struct lacks becomes zero; what a newer one's has more must be.
bool check_struct(ClrtError *error, const char *what, const void *given, void *copy, size_t size);
