// SPDX-License-Identifier: MIT
// Formats --help with names on the left and wrapped texts on the right. --help shows only the part
// of each text before the first semicolon. The man page shows the whole text.
#include "cli/commands.h"

#include "cli/options/option.h"

#include <string.h>

#define NAME_WIDTH 28
#define TEXT_WIDTH 72

// Returns the length of the first line of `text`. Lines end at a space if possible.
static int line_length(const char *text)
{
    const int length = (int)strlen(text);
    if (length <= TEXT_WIDTH)
        return length;
    int end = TEXT_WIDTH;
    while (end > 0 && text[end] != ' ')
        end--;
    return end > 0 ? end : TEXT_WIDTH;
}

static void write_item(FILE *stream, const char *name, const char *help, const char *class)
{
    char copy[512];
    const char *text = copy;
    snprintf(copy, sizeof copy, class[0] != '\0' ? "%.*s [%s]" : "%.*s", (int)strcspn(help, ";"),
             help, class);
    const bool fits = strlen(name) < NAME_WIDTH;
    if (!fits)
        fprintf(stream, "%s\n", name);
    for (const char *left = fits ? name : ""; *text != '\0'; left = "") {
        const int length = line_length(text);
        fprintf(stream, "%-*s%.*s\n", NAME_WIDTH, left, length, text);
        text += length + (text[length] == ' ');
    }
}

static void write_option(FILE *stream, const Option *option)
{
    char name[64], letter[8] = "    ";
    if (option->letter != 0)
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    const bool separate = option->argument != NULL && !option_argument_is_optional(option);
    if (option_key(option) != NULL)
        snprintf(name, sizeof name, "        %s=%s", option_key(option), option->argument);
    else
        snprintf(name, sizeof name, "  %s--%s%s%s", letter, option->name, separate ? " " : "",
                 option->argument == NULL ? "" : option->argument);
    write_item(stream, name, option->help, option_class_names[option->class]);
}

static void write_group(FILE *stream, OptionGroup group)
{
    fprintf(stream, "\n%s:\n", option_group_names[group]);
    for (size_t i = 0; i < option_count; i++)
        if (option_table[i].group == group)
            write_option(stream, &option_table[i]);
}

static void write_classes(FILE *stream)
{
    fputs("\nEffects of settings on the picture:\n", stream);
    for (size_t i = CLASS_NONE + 1; i < OPTION_CLASSES; i++) {
        char name[32];
        snprintf(name, sizeof name, "  [%s]", option_class_names[i]);
        write_item(stream, name, option_class_meanings[i], "");
    }
}

static void write_commands(FILE *stream)
{
    fputs("Usage:\n", stream);
    for (size_t i = 0; i < command_count; i++) {
        char text[COMMAND_TEXT_SIZE], name[COMMAND_TEXT_SIZE + 2];
        command_write(&command_table[i], text);
        snprintf(name, sizeof name, "  %s", text);
        write_item(stream, name, command_table[i].help, "");
    }
    fputs("A scene is a scene file (.scn) or a single mesh; - reads standard input.\n", stream);
}

static void write_exclusions(FILE *stream)
{
    fputs("\nOptions that exclude each other:\n", stream);
    for (size_t i = 0; i < exclusion_count; i++) {
        char text[EXCLUSION_TEXT_SIZE];
        exclusion_write(&exclusion_table[i], text);
        fprintf(stream, "  %s\n", text);
    }
}

static void write_channels(FILE *stream)
{
    char text[256] = "";
    for (size_t i = 0; i < aov_count; i++)
        strcat(strcat(text, i > 0 ? ", " : ""), aov_table[i].name);
    fputc('\n', stream);
    write_item(stream, "Channels of --aov:", text, "");
}

void options_write_help(FILE *stream)
{
    write_commands(stream);
    for (int group = 0; group < OPTION_GROUPS; group++)
        write_group(stream, (OptionGroup)group);
    write_exclusions(stream);
    write_channels(stream);
    write_classes(stream);
    fprintf(
        stream,
        "\nExit status: 0 done; 1 faults found by check, a limit of compare exceeded, or a hash,\n"
        "             error or time goal missed; 2 usage; 3 scene, mesh or picture;\n"
        "             4 device; 5 output; 75 busy (--resume); 128 + signal if stopped.\n"
        "man clrt describes the options in full.\n");
}
