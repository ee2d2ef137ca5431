// SPDX-License-Identifier: MIT
// Arguments of callers -> error messages.  All arguments are validated here; code below this folder
// asserts what it requires.
#pragma once

#include "base/error.h"
#include "library/clrt.h"

// Fills error unless it is NULL, and returns false.
__attribute__((format(printf, 3, 4))) bool check_fail(ClrtError *error, ClrtFault fault,
                                                      const char *format, ...);

// check_fail with a stage's message.
bool check_fail_for(ClrtError *error, ClrtFault fault, const Error *cause);

// Each fails with CLRT_ARGUMENT; what names the argument in the message.
bool check_given(ClrtError *error, const char *what, const void *pointer);
bool check_number(ClrtError *error, const char *what, double number, double low, double high);
bool check_vector(ClrtError *error, const char *what, const double vector[3], double most);
bool check_color(ClrtError *error, const char *what, const double color[3]);

// Copies one of clrt.h's structs into copy, which has size bytes.  Members missing from an older
// program's struct become zero; unknown members of a newer one's must be zero.
bool check_struct(ClrtError *error, const char *what, const void *given, void *copy, size_t size);
