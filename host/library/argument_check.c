// SPDX-License-Identifier: MIT
// Checks callers' arguments, and copies structs from and to callers. Structs may have the size of
// an earlier or later version of the library.
#include "library/handles.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// No version of the library has a larger struct, so a larger size means that the caller has not
// initialized the member `size`.
#define LARGEST_STRUCT 4096

bool library_fail(ClrtError *error, ClrtFault fault, const char *format, ...)
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

bool library_fail_for(ClrtError *error, ClrtFault fault, const Error *cause)
{
    return library_fail(error, fault, "%s", cause->text);
}

bool argument_given(ClrtError *error, const char *what, const void *pointer)
{
    return pointer != NULL || library_fail(error, CLRT_ARGUMENT, "%s is NULL", what);
}

// NaN fails both comparisons.
bool argument_number(ClrtError *error, const char *what, double number, double low, double high)
{
    return (number >= low && number <= high) ||
           library_fail(error, CLRT_ARGUMENT, "%s is %.10g, not between %g and %g", what, number,
                        low, high);
}

static bool argument_three(ClrtError *error, const char *what, const double three[3], double low,
                           double high)
{
    for (int i = 0; i < 3; i++)
        if (!argument_number(error, what, three[i], low, high))
            return false;
    return true;
}

bool argument_vector(ClrtError *error, const char *what, const double vector[3], double most)
{
    return argument_given(error, what, vector) && argument_three(error, what, vector, -most, most);
}

bool argument_color(ClrtError *error, const char *what, const double color[3])
{
    return argument_given(error, what, color) && argument_three(error, what, color, 0, 1);
}

// Returns whether all bytes are zero. Members that only later versions have must be zero, because
// this version can only apply their defaults.
static bool is_zero(const unsigned char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (bytes[i] != 0)
            return false;
    return true;
}

bool argument_struct(ClrtError *error, const char *what, const void *given, void *copy, size_t size)
{
    size_t given_size;
    if (!argument_given(error, what, given))
        return false;
    memcpy(&given_size, given, sizeof given_size);
    if (given_size < sizeof given_size || given_size > LARGEST_STRUCT)
        return library_fail(error, CLRT_ARGUMENT, "%s has a size of %zu, not %zu", what, given_size,
                            size);
    const size_t known = given_size < size ? given_size : size;
    memset(copy, 0, size);
    memcpy(copy, given, known);
    return is_zero((const unsigned char *)given + known, given_size - known) ||
           library_fail(error, CLRT_ARGUMENT, "%s sets members that libclrt %s does not know", what,
                        clrt_version());
}

bool argument_fill(ClrtError *error, const char *what, void *given, const void *filled, size_t size)
{
    size_t given_size;
    unsigned char unused[LARGEST_STRUCT];
    if (!argument_struct(error, what, given, unused, size))
        return false;
    memcpy(&given_size, given, sizeof given_size);
    memcpy(given, filled, given_size < size ? given_size : size);
    memcpy(given, &given_size, sizeof given_size);
    return true;
}
