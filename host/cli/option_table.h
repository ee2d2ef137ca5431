// SPDX-License-Identifier: MIT
// All options of the command line: what the parser and --help are made of.
#pragma once

#include "cli/option_reader.h"

#include <stddef.h>

// What an option is for; --help goes through the purposes in this order.
typedef enum {
    GROUP_OUTPUT,
    GROUP_PICTURE,
    GROUP_QUALITY,
    GROUP_SPEED,
    GROUP_JOB,
    GROUP_DEVICE,
    GROUP_STATISTICS,
    GROUP_GEOMETRY,
    GROUP_REPORT,
    GROUP_WINDOW,
    GROUP_TALK,
    OPTION_GROUPS
} OptionGroup;

// What a setting may do to the picture that is asked for.
typedef enum {
    CLASS_NONE,        // asks for another picture, or for none
    CLASS_EXACT,       // the same bits
    CLASS_BOUNDED,     // a bound on how far off it is can be stated, and holds
    CLASS_STATISTICAL, // how far off it is can be measured
    OPTION_CLASSES
} OptionClass;

typedef struct {
    const char *name;
    char letter;          // 0 without a short form
    const char *argument; // NULL without one; all its words with '|' between where it is one of
                          // few; in brackets where it may be left out, and is then given with '='
                          // alone
    ReadValue *read;
    OptionGroup group;
    OptionClass class;
    const char *help;
} Option;

#define OPTIONS_MOST 64

// In the order of their groups.
extern const Option option_table[];
extern const size_t option_count; // at most OPTIONS_MOST

// The heading of a group.
extern const char *const option_group_names[OPTION_GROUPS];

// A word and what it means, "" and "" for CLASS_NONE.
extern const char *const option_class_names[OPTION_CLASSES];
extern const char *const option_class_meanings[OPTION_CLASSES];

bool option_argument_is_optional(const Option *option);

// Returns whether the value is the name of a file.
bool option_names_file(const Option *option);

// Returns whether the command line names the option, which must be in the table, with any value.
// Rules about options that exclude each other ask this: a value may equal the default.
bool option_is_given(const Options *options, const char *name);
