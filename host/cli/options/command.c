// SPDX-License-Identifier: MIT
// The table of commands. To open a scene file called like a command, users write ./NAME.
#include "cli/options/option.h"

#include <stdio.h>
#include <string.h>

// Commands that an option selects.
static const Command silent_commands[] = {
    {.name = "--explain-pixel", .action = ACTION_EXPLAIN, .use = FOR_PIXEL},
    {.name = "--explain", .action = ACTION_EXPLAIN_SCENE, .use = FOR_EXPLAIN},
};

#define SILENT_COMMANDS (sizeof silent_commands / sizeof silent_commands[0])

const Command *command_of_action(Action action)
{
    for (size_t i = 0; i < SILENT_COMMANDS; i++)
        if (silent_commands[i].action == action)
            return &silent_commands[i];
    return NULL;
}

const Command command_table[] = {
    {"check", ACTION_CHECK, FOR_CHECK, "SCENE",
     "report faults in the scene's geometry; draw nothing", NULL},
    {"compare", ACTION_COMPARE, FOR_COMPARE, "PICTURE PICTURE",
     "report how much two pictures differ; -o draws a map of the differences",
     "the names of two pictures"},
    {"merge", ACTION_MERGE, FOR_MERGE, "PART...",
     "join the EXR files of all parts (--part) into the whole picture (-o)", NULL},
    {"convert", ACTION_CONVERT, FOR_CONVERT, "SCENE FILE",
     "write a scene or mesh as FILE: a .scn with a binary .ply per mesh beside it, or one .ply "
     "with all meshes",
     "the names of a scene or mesh and of the file to write"},
};

const size_t command_count = sizeof command_table / sizeof command_table[0];

const Command *command_named(const char *word)
{
    for (size_t i = 0; i < command_count; i++)
        if (strcmp(word, command_table[i].name) == 0)
            return &command_table[i];
    return NULL;
}

bool command_takes(const Command *command, const Option *option)
{
    return (option->uses & (command != NULL ? command->use : FOR_PICTURE)) != 0;
}

static size_t append_command(const char *name, char *text, size_t size, size_t length)
{
    if (length >= size)
        return length;
    return length + (size_t)snprintf(text + length, size - length, "%sclrt %s",
                                     length > 0 ? " or " : "", name);
}

void command_list_takers(const Option *option, char *text, size_t size)
{
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; i < command_count; i++)
        if (command_takes(&command_table[i], option))
            length = append_command(command_table[i].name, text, size, length);
    for (size_t i = 0; i < SILENT_COMMANDS; i++)
        if (command_takes(&silent_commands[i], option))
            length = append_command(silent_commands[i].name, text, size, length);
}
