// SPDX-License-Identifier: MIT
// Numbers are read whole: anything left over is a fault, which the message quotes.
#include "cli/option_value.h"

#include "base/number.h"

#include <string.h>

bool read_count(const char *value, const char *option, int64_t highest, uint32_t *count,
                Error *error)
{
    int64_t number;
    const char *end = value + strlen(value);
    if (integer_parse(value, end, &number) != end || number < 1 || number > highest)
        return error_set(error, "--%s wants an integer between 1 and %lld, not '%s'", option,
                         (long long)highest, value);
    *count = (uint32_t)number;
    return true;
}

bool read_part(const char *value, const char *option, double *part, Error *error)
{
    const char *end = value + strlen(value);
    return (number_parse(value, end, part) == end && *part > 0 && *part <= 1) ||
           error_set(error, "--%s wants a number above 0 and up to 1, not '%s'", option, value);
}

bool read_area(const char *value, const char *option, int64_t highest, uint32_t area[2],
               Error *error)
{
    int64_t width, height;
    const char *end = value + strlen(value);
    const char *cross = integer_parse(value, end, &width);
    if (cross == NULL || *cross != 'x' || integer_parse(cross + 1, end, &height) != end ||
        width < 1 || width > highest || height < 1 || height > highest)
        return error_set(error, "--%s wants WIDTHxHEIGHT, each between 1 and %lld, not '%s'",
                         option, (long long)highest, value);
    area[0] = (uint32_t)width;
    area[1] = (uint32_t)height;
    return true;
}

int read_choice(const char *value, const char *option, const char *const *names, int count,
                Error *error)
{
    char list[128] = "";
    for (int i = 0; i < count; i++) {
        if (strcmp(value, names[i]) == 0)
            return i;
        strncat(list, i == 0 ? "" : i + 1 == count ? " or " : ", ", 8);
        strncat(list, names[i], 24);
    }
    error_set(error, "--%s wants %s, not '%s'", option, list, value);
    return -1;
}
