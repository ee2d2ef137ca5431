// SPDX-License-Identifier: MIT
// All options of the command line: what the parser and --help are made of.
#pragma once

#include "cli/option_reader.h"

#include <stddef.h>

typedef struct {
    const char *name;
    char letter;          // 0 without a short form
    const char *argument; // NULL without one; in brackets where it may be left out, and is then
                          // given with '=' alone
    ReadValue *read;
    const char *help;
} Option;

#define OPTIONS_MOST 64

extern const Option option_table[];
extern const size_t option_count; // at most OPTIONS_MOST

bool option_argument_is_optional(const Option *option);
