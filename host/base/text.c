// SPDX-License-Identifier: MIT
// Formats texts, and suggests words by edit distances. These are computed row by row (Wagner and
// Fischer, "The string-to-string correction problem", 1974). Only one row of the table is kept.
#include "base/text.h"

#include "base/array.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST_WORD 24

char *text_format(Error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const size_t size = (size_t)vsnprintf(NULL, 0, format, arguments) + 1;
    va_end(arguments);
    char *text = memory_raw(size, 1, error);
    va_start(arguments, format);
    if (text != NULL)
        vsnprintf(text, size, format, arguments);
    va_end(arguments);
    return text;
}

char *text_copy(const char *text, Error *error)
{
    return text_format(error, "%s", text);
}

bool text_is(const char *text, size_t length, const char *word)
{
    return strlen(word) == length && memcmp(text, word, length) == 0;
}

const char *text_file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t edit_distance(const char *text, size_t length, const char *word)
{
    size_t row[LONGEST_WORD + 1];
    const size_t columns = strlen(word);
    for (size_t column = 0; column <= columns; column++)
        row[column] = column;
    for (size_t line = 0; line < length; line++) {
        size_t diagonal = row[0];
        row[0] = line + 1;
        for (size_t column = 0; column < columns; column++) {
            const size_t changed = diagonal + (text[line] != word[column]);
            diagonal = row[column + 1];
            row[column + 1] = smaller(changed, smaller(row[column], diagonal) + 1);
        }
    }
    return row[columns];
}

const char *word_nearest(const char *text, size_t length, const char *const *words, size_t count)
{
    const char *nearest = NULL;
    size_t least = length / 2 + 1;
    if (length > LONGEST_WORD)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        const size_t distance =
            strlen(words[i]) > LONGEST_WORD ? LONGEST_WORD : edit_distance(text, length, words[i]);
        if (distance < least) {
            least = distance;
            nearest = words[i];
        }
    }
    return nearest;
}
