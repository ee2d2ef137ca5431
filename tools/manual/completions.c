// SPDX-License-Identifier: MIT
// Writes the table of options as lines that the shells' completions read.
#include "cli/options/option.h"
#include "image/image_file.h"
#include "manual.h"

#include <ctype.h>
#include <string.h>

// Writes a space, the key and the word for each word of list. Skips words that begin with a
// capital, because they stand for any value.
static void write_words(FILE *stream, const char *key, const char *list, const char *separators)
{
    for (; list[0] != '\0'; list += strspn(list, separators)) {
        const size_t length = strcspn(list, separators);
        if (!isupper((unsigned char)list[0]))
            fprintf(stream, " %s%.*s", key, (int)length, list);
        list += length;
    }
}

// Writes the values of --tune: "key=word", or "key=" if any value may follow.
static void write_tunings(FILE *stream)
{
    for (size_t i = 0; i < option_count; i++) {
        char key[32];
        const char *list = option_table[i].argument;
        if (option_key(&option_table[i]) == NULL)
            continue;
        snprintf(key, sizeof key, "%s=", option_key(&option_table[i]));
        if (isupper((unsigned char)list[0]))
            fprintf(stream, " %s", key);
        write_words(stream, key, list, "[:]|");
    }
}

static void write_values(FILE *stream, const Option *option)
{
    char names[256]; // without OpenImageIO, advice in parentheses follows the names
    snprintf(names, sizeof names, "%.*s", (int)strcspn(image_format_names(), "("),
             image_format_names());
    if (option->set == set_tune)
        write_tunings(stream);
    else if (option->set == set_format)
        write_words(stream, "", names, ", ");
    else
        write_words(stream, "", option->argument, "[=]|");
}

static bool has_words(const Option *option)
{
    return strchr(option->argument, '|') != NULL || option->set == set_format ||
           option->set == set_tune;
}

static const char *kind_of(const Option *option)
{
    if (option_names_file(option))
        return "file";
    return has_words(option) ? "words" : "other";
}

static void write_option(FILE *stream, const Option *option)
{
    for (size_t i = 0; i < command_count; i++) {
        const Command *command = &command_table[i];
        if (command_is_first(command) && command_takes(command->name, option))
            fprintf(stream, "%s ", command->name[0] == '\0' ? "-" : command->name);
    }
    fprintf(stream, "|%s|%.1s|", option->name, (const char[]){option->letter, '\0'});
    if (option->argument == NULL) {
        fputs("flag|", stream);
    } else {
        fprintf(stream, "%s%s|", option_argument_is_optional(option) ? "optional" : "",
                kind_of(option));
        if (strcmp(kind_of(option), "words") == 0)
            write_values(stream, option);
    }
    fprintf(stream, "|%s", option->help);
}

void write_option_table(FILE *stream)
{
    for (size_t i = 0; i < option_count; i++) {
        if (option_key(&option_table[i]) != NULL)
            continue;
        fputs(i > 0 ? "\n" : "", stream);
        write_option(stream, &option_table[i]);
    }
}

void write_command_names(FILE *stream)
{
    for (size_t i = 1; i < command_count; i++)
        if (command_is_first(&command_table[i]))
            fprintf(stream, "%s%s", i > 1 ? " " : "", command_table[i].name);
}
