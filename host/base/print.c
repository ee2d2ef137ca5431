// SPDX-License-Identifier: MIT
// Prints texts. The library contains all of text.c, but may not print. Printing therefore has its
// own file.
#include "base/print.h"

#include "base/error.h"

#include <stdarg.h>
#include <stdlib.h>

void print_text(FILE *stream, const char *format, ...)
{
    char *text;
    va_list arguments;
    va_start(arguments, format);
    const bool ok = vasprintf(&text, format, arguments) >= 0;
    va_end(arguments);
    if (!ok)
        return;
    text_hide_controls(text);
    fputs(text, stream);
    free(text);
}
