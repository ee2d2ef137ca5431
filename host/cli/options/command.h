// SPDX-License-Identifier: MIT
// The commands.  The first operand may name one; otherwise clrt draws.
#pragma once

#include "cli/options/option.h"

typedef struct {
    const char *name;
    Action action;
    unsigned use;         // FOR_...: the command takes options of that use
    const char *operands; // the arguments after its name
    const char *help;
    const char *two_operands; // describes its two file operands; NULL if it takes a scene
} Command;

extern const Command command_table[];
extern const size_t command_count;

// Returns NULL if no command has that name.
const Command *command_named(const char *word);

// Returns the command that an option selected; NULL for none.
const Command *command_of_action(Action action);

// Returns whether the command takes the option; NULL means drawing.
bool command_takes(const Command *command, const Option *option);

// Writes the commands that take the option, as "clrt check or clrt compare".
void command_list_takers(const Option *option, char *text, size_t size);
