// SPDX-License-Identifier: MIT
// The commands. If the first operand names no command, clrt renders a scene.
#pragma once

#include "cli/options/option.h"

typedef struct {
    const char *name;
    Action action;
    unsigned use;         // one FOR_... bit; the command accepts the options with this bit
    const char *operands; // the arguments after the name, for --help
    const char *help;
    const char *two_operands; // describes two file operands for a message; NULL: one scene, or the
                              // parts of merge
} Command;

extern const Command command_table[];
extern const size_t command_count;

// Returns the command called word, or NULL.
const Command *command_named(const char *word);

// Returns the command that an option such as --explain selects, or NULL.
const Command *command_of_action(Action action);

// Returns whether the command accepts the option. If command is NULL, clrt renders.
bool command_takes(const Command *command, const Option *option);

// Writes the commands that accept the option, for example "clrt check or clrt compare".
void command_list_takers(const Option *option, char *text, size_t size);
