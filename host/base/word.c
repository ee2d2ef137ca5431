// SPDX-License-Identifier: MIT
// Computes edit distances row by row (Wagner and Fischer, "The string-to-string correction
// problem", 1974). Only one row of the table is kept.
#include "base/word.h"

#include <string.h>

#define LONGEST_WORD 24

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
