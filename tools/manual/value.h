// SPDX-License-Identifier: MIT
// The values that an option takes, for pages and completions.
#pragma once

#include "cli/options/option.h"

typedef enum {
    VALUE_NONE, // the option takes no value
    VALUE_FILE,
    VALUE_WORDS, // one of a list of words
    VALUE_OTHER
} ValueKind;

#define VALUE_WORDS_SIZE 256

// Returns the kind of the value. For VALUE_WORDS, stores the words in `words`, separated by blanks.
// For other kinds, `words` becomes empty.
ValueKind value_kind(const Option *option, char words[VALUE_WORDS_SIZE]);

// Stores the name of the option's argument, without the "[=" and "]" of an optional argument.
void value_name(const Option *option, char *name, size_t size);
