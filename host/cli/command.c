// SPDX-License-Identifier: MIT
// The table of commands.  A scene file with the name of one is reached by ./NAME.
#include "cli/command.h"

#include <stdio.h>
#include <string.h>

static const char *const check_options[] = {"bvh",    "no-bvh", "device",  "threads",
                                            "kernel", "nodes",  "lanes",   "precision",
                                            "json",   "quiet",  "verbose", NULL};

static const char *const compare_options[] = {"output", "format",  "fail", "json",
                                              "quiet",  "verbose", NULL};

static const char *const merge_options[] = {"output",      "format", "no-metadata", "hash",
                                            "expect-hash", "quiet",  NULL};

static const char *const convert_options[] = {"bad-geometry", "quiet", "verbose", NULL};

static const char *const explain_options[] = {
    "explain-pixel", "size",    "view",   "aa",      "max-level", "bvh",       "no-bvh",
    "device",        "threads", "kernel", "nodes",   "lanes",     "precision", "encode",
    "bad-geometry",  "json",    "quiet",  "verbose", NULL};

static const char *const explain_scene_options[] = {
    "explain",   "size",       "view",         "aa",    "bvh",     "no-bvh", "device",
    "threads",   "specialize", "repeat",       "stats", "kernel",  "nodes",  "lanes",
    "precision", "json",       "bad-geometry", "quiet", "verbose", NULL};

// Asked for by an option.
static const Command silent_commands[] = {
    {.name = "--explain-pixel", .action = ACTION_EXPLAIN, .options = explain_options},
    {.name = "--explain", .action = ACTION_EXPLAIN_SCENE, .options = explain_scene_options},
};

#define SILENT_COMMANDS (sizeof silent_commands / sizeof silent_commands[0])

const Command *command_of_action(Action action)
{
    for (size_t i = 0; i < SILENT_COMMANDS; i++)
        if (silent_commands[i].action == action)
            return &silent_commands[i];
    return NULL;
}

// What no picture needs.
static const char *const command_options[] = {"fail", "json", NULL};

const Command command_table[] = {
    {"check", ACTION_CHECK, check_options, "SCENE",
     "look for what is wrong in the scene's geometry, and draw nothing", NULL},
    {"compare", ACTION_COMPARE, compare_options, "PICTURE PICTURE",
     "tell how much two pictures differ; -o draws a map of it", "the names of two pictures"},
    {"merge", ACTION_MERGE, merge_options, "PART...",
     "join the EXR files of all parts that --part drew into the whole picture, -o", NULL},
    {"convert", ACTION_CONVERT, convert_options, "SCENE FILE",
     "write a scene or mesh in any format as FILE: .scn, with a binary .ply for each mesh beside "
     "it, or .ply, all meshes in one",
     "the names of a scene or mesh and of the file to write"},
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

static size_t add_taker(const char *name, char *text, size_t size, size_t length)
{
    if (length >= size)
        return length;
    return length + (size_t)snprintf(text + length, size - length, "%sclrt %s",
                                     length > 0 ? " or " : "", name);
}

void command_list_takers(const char *option, char *text, size_t size)
{
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; i < command_count; i++)
        if (is_among(option, command_table[i].options))
            length = add_taker(command_table[i].name, text, size, length);
    for (size_t i = 0; i < SILENT_COMMANDS; i++)
        if (is_among(option, silent_commands[i].options))
            length = add_taker(silent_commands[i].name, text, size, length);
}
