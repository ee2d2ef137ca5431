// SPDX-License-Identifier: MIT
// A NaN fails every range check.
#include "library/check.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// No version of the library has a larger struct; larger sizes come from uninitialized memory.
#define LARGEST_STRUCT 4096

bool check_fail(ClrtError *error, ClrtFault fault, const char *format, ...)
{
    va_list arguments;
    if (error == NULL)
        return false;
    error->fault = fault;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    return false;
}

bool check_fail_for(ClrtError *error, ClrtFault fault, const Error *cause)
{
    return check_fail(error, fault, "%s", cause->text);
}

bool check_given(ClrtError *error, const char *what, const void *pointer)
{
    return pointer != NULL || check_fail(error, CLRT_ARGUMENT, "%s is NULL", what);
}

bool check_number(ClrtError *error, const char *what, double number, double low, double high)
{
    return (number >= low && number <= high) ||
           check_fail(error, CLRT_ARGUMENT, "%s is %g, not between %g and %g", what, number, low,
                      high);
}

static bool check_three(ClrtError *error, const char *what, const double three[3], double low,
                        double high)
{
    for (int i = 0; i < 3; i++)
        if (!check_number(error, what, three[i], low, high))
            return false;
    return true;
}

bool check_vector(ClrtError *error, const char *what, const double vector[3], double most)
{
    return check_given(error, what, vector) && check_three(error, what, vector, -most, most);
}

bool check_color(ClrtError *error, const char *what, const double color[3])
{
    return check_given(error, what, color) && check_three(error, what, color, 0, 1);
}

// Returns whether all bytes are zero. Members that this version does not know must be zero, which
// selects their default.
static bool is_zero(const unsigned char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (bytes[i] != 0)
            return false;
    return true;
}

bool check_struct(ClrtError *error, const char *what, const void *given, void *copy, size_t size)
{
    size_t given_size;
    if (!check_given(error, what, given))
        return false;
    memcpy(&given_size, given, sizeof given_size);
    if (given_size < sizeof given_size || given_size > LARGEST_STRUCT)
        return check_fail(error, CLRT_ARGUMENT, "%s has a size of %zu, not %zu", what, given_size,
                          size);
    const size_t known = given_size < size ? given_size : size;
    memset(copy, 0, size);
    memcpy(copy, given, known);
    return is_zero((const unsigned char *)given + known, given_size - known) ||
           check_fail(error, CLRT_ARGUMENT, "%s asks for what libclrt %s does not know", what,
                      clrt_version());
}
