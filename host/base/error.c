// SPDX-License-Identifier: MIT
// Formats the first failure and ignores the others.
#include "base/error.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>

// Returns whether the bytes are a control character from U+0080 to U+009F in UTF-8.
static bool is_second_control(const char *bytes)
{
    const unsigned char last = (unsigned char)bytes[1];
    return bytes[0] == '\xc2' && last >= 0x80 && last < 0xa0;
}

void text_hide_controls(char *text)
{
    for (char *c = text; *c != '\0'; c++)
        if (is_second_control(c))
            c[0] = c[1] = '?';
        else if (iscntrl((unsigned char)*c) && *c != '\n' && *c != '\t')
            *c = '?';
}

bool error_set(Error *error, const char *format, ...)
{
    if (error->text[0] == '\0') {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(error->text, sizeof error->text, format, arguments);
        va_end(arguments);
        text_hide_controls(error->text);
    }
    return false;
}

bool error_out_of_memory(Error *error, unsigned long long bytes)
{
    return error_set(error, "out of memory: %llu bytes could not be allocated", bytes);
}
