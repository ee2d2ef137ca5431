// SPDX-License-Identifier: MIT
// The table of all options. The parser, --help, the man page and the completions iterate over it.
#pragma once

#include "cli/options/option.h"

#define OPTIONS_MOST 64

// Sorted by group.
extern const Option option_table[];
extern const size_t option_count; // at most OPTIONS_MOST

// The heading of a group.
extern const char *const option_group_names[OPTION_GROUPS];

// The name of a class and its meaning; both are "" for CLASS_NONE.
extern const char *const option_class_names[OPTION_CLASSES];
extern const char *const option_class_meanings[OPTION_CLASSES];

// Returns whether the command line contains the option. name must be in option_table.
bool option_is_given(const Options *options, const char *name);
