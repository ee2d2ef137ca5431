// SPDX-License-Identifier: MIT
// The table of commands.  A scene file with the name of one is reached by ./NAME.
#include "cli/command.h"

#include <string.h>

static const char *const check_options[] = {"bvh",    "no-bvh", "device",  "threads",
                                            "kernel", "nodes",  "lanes",   "precision",
                                            "json",   "quiet",  "verbose", NULL};

// What no picture needs.
static const char *const command_options[] = {"json", NULL};

const Command command_table[] = {
    {"check", ACTION_CHECK, check_options, "SCENE",
     "look for what is wrong in the scene's geometry, and draw nothing"},
};

const size_t command_count = sizeof command_table / sizeof command_table[0];

static bool is_among(const char *name, const char *const *names)
{
    while (*names != NULL && strcmp(name, *names) != 0)
        names++;
    return *names != NULL;
}

const Command *command_named(const char *word)
{
    for (size_t i = 0; i < command_count; i++)
        if (strcmp(word, command_table[i].name) == 0)
            return &command_table[i];
    return NULL;
}

bool command_takes(const Command *command, const char *option)
{
    return command != NULL ? is_among(option, command->options)
                           : !is_among(option, command_options);
}
