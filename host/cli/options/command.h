// SPDX-License-Identifier: MIT
// The commands: what clrt does when its first word that is no option names one, instead of drawing.
#pragma once

#include "cli/options/option.h"

typedef struct {
    const char *name;
    Action action;
    unsigned use;         // FOR_...: options of that use are the command's
    const char *operands; // what follows its name
    const char *help;
    const char *two_operands; // names two files in words; NULL where it takes a scene
} Command;

extern const Command command_table[];
extern const size_t command_count;

// NULL where the word names none.
const Command *command_named(const char *word);

// The command that an option asks for, which has no word of its own; NULL where none did.
const Command *command_of_action(Action action);

// Returns whether the command takes the option; NULL stands for drawing.
bool command_takes(const Command *command, const Option *option);

// Writes "clrt check or clrt compare": the commands that take the option.
void command_list_takers(const Option *option, char *text, size_t size);
