// SPDX-License-Identifier: MIT
// The parts of the man page and of the completions that come from the tables of options, commands
// and channels, and from the window's list of keys.
#pragma once

#include <stdio.h>

typedef void WritePart(FILE *stream);

// Parts of clrt(1), as lines of mdoc.
WritePart write_synopsis, write_commands, write_options, write_exclusions, write_classes,
    write_channels, write_keys;

// The names of the commands, separated by spaces.
WritePart write_command_names;

// A line for each option: commands|name|letter|kind|values|help. The commands are separated by
// spaces, and "-" stands for rendering. The kind is flag, file, words or other. The word "optional"
// precedes the kind of an optional argument. The text has no quotes, backslashes or dollar signs.
WritePart write_option_table;
