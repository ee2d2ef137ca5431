// SPDX-License-Identifier: MIT
// The kinds of an option's value.
#pragma once

#include "cli/options/option.h"

typedef enum {
    VALUE_NONE, // the option takes none
    VALUE_FILE,
    VALUE_WORDS, // one of few
    VALUE_OTHER
} ValueKind;

#define VALUE_WORDS_SIZE 256

// Fills words with the words there are, a blank between each; empty but for VALUE_WORDS.
ValueKind value_kind(const Option *option, char words[VALUE_WORDS_SIZE]);

// The argument's name without the brackets of one that may be left out.
void value_name(const Option *option, char *name, size_t size);
