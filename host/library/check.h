// SPDX-License-Identifier: MIT
// Validates the arguments of the library's callers. Other code only asserts its requirements.
#pragma once

#include "base/error.h"
#include "library/clrt.h"

// Fills error unless it is NULL, and returns false.
__attribute__((format(printf, 3, 4))) bool check_fail(ClrtError *error, ClrtFault fault,
                                                      const char *format, ...);

// Calls check_fail with the message of cause.
bool check_fail_for(ClrtError *error, ClrtFault fault, const Error *cause);

// Return false with CLRT_ARGUMENT if the argument is invalid. The parameter what names the
// argument. Vector components are in [-most, most], colors in [0, 1].
bool check_given(ClrtError *error, const char *what, const void *pointer);
bool check_number(ClrtError *error, const char *what, double number, double low, double high);
bool check_vector(ClrtError *error, const char *what, const double vector[3], double most);
bool check_color(ClrtError *error, const char *what, const double color[3]);

// Copies a struct of clrt.h into copy, which has size bytes. Members that the given struct lacks
// become zero. Additional members of the given struct must be zero.
bool check_struct(ClrtError *error, const char *what, const void *given, void *copy, size_t size);
