// SPDX-License-Identifier: MIT
// Writes mdoc. Option names become .Fl, literal words .Cm, and other values .Ar.
#include "cli/commands.h"
#include "cli/options/option.h"
#include "manual.h"
#include "render/aov.h"

#include <ctype.h>
#include <string.h>

// Writes a help text of the table as a sentence, with a capital and a period. Escapes the
// leading hyphens of options, so that they remain ASCII hyphens.
static void write_sentence(FILE *stream, const char *text)
{
    char before = ' ';
    fputc(toupper((unsigned char)text[0]), stream);
    for (const char *c = text + 1; *c != '\0'; c++) {
        if (*c == '-' && (before == ' ' || before == '-' || c[1] == '-'))
            fputs("\\-", stream);
        else if (*c == '\\')
            fputs("\\e", stream);
        else if (*c == '^')
            fputs("\\(ha", stream);
        else
            fputc(*c, stream);
        before = *c;
    }
    fputs(".\n", stream);
}

// Writes an option's argument, with .Cm for literal words and .Ar for other values.
static void write_words(FILE *stream, const Option *option)
{
    char words[128];
    const char *argument = option->argument + strspn(option->argument, "[=");
    snprintf(words, sizeof words, "%.*s",
             (int)strcspn(argument, option_argument_is_optional(option) ? "]" : ""), argument);
    const char *separator = "";
    for (char *rest = words, *word; (word = strsep(&rest, "|")) != NULL; separator = " | ")
        fprintf(stream, "%s%s %s", separator, isupper((unsigned char)word[0]) ? "Ar" : "Cm", word);
}

static void write_name(FILE *stream, const Option *option)
{
    const char *key = option_key(option);
    fprintf(stream, "Fl \\-%.*s", (int)strcspn(option->name, " "), option->name);
    if (key != NULL)
        fprintf(stream, " Cm %s", key);
}

static void write_value(FILE *stream, const Option *option)
{
    if (option->argument == NULL)
        return;
    const bool optional = option_argument_is_optional(option);
    fputs(optional ? " Ns Oo = Ns " : option_key(option) != NULL ? " Ns = Ns " : " ", stream);
    write_words(stream, option);
    fputs(optional ? " Oc" : "", stream);
}

static void write_option(FILE *stream, const Option *option)
{
    fputs(".It ", stream);
    if (option->letter != 0)
        fprintf(stream, "Fl %c , ", option->letter);
    write_name(stream, option);
    write_value(stream, option);
    fputc('\n', stream);
    write_sentence(stream, option->help);
    if (option->class != CLASS_NONE)
        fprintf(stream, ".Bq %s\n", option_class_names[option->class]);
}

void write_options(FILE *stream)
{
    for (int group = 0; group < OPTION_GROUPS; group++) {
        fprintf(stream, ".Ss %s\n.Bl -tag -width Ds\n", option_group_names[group]);
        for (size_t i = 0; i < option_count; i++)
            if (option_table[i].group == (OptionGroup)group)
                write_option(stream, &option_table[i]);
        fputs(".El\n", stream);
    }
}

// Writes macros for the command's name and operands, without the name of the program.
static void write_words_of(FILE *stream, const Command *command)
{
    char words[COMMAND_TEXT_SIZE], *rest = words;
    if (command->name[0] != '\0')
        fprintf(stream, "Cm %s", command->name);
    snprintf(words, sizeof words, "%s", command->operands);
    for (char *word = strsep(&rest, " "); word != NULL; word = strsep(&rest, " "))
        if (word[0] == '-')
            fprintf(stream, " Fl %s%s", word[1] == '-' ? "\\" : "", word + 1);
        else if (word[0] != '\0')
            fprintf(stream, "%sAr %s", command->name[0] == '\0' && word == words ? "" : " ", word);
}

void write_synopsis(FILE *stream)
{
    for (size_t i = 0; i < command_count; i++) {
        fputs(".Nm\n.", stream);
        write_words_of(stream, &command_table[i]);
        fputs("\n.Op Ar options\n", stream);
    }
}

// Lists the options that a command accepts.
static void write_taken(FILE *stream, const Command *command)
{
    size_t left = 0;
    for (size_t i = 0; i < option_count; i++)
        left += (option_table[i].uses & command->use) != 0;
    for (size_t i = 0; i < option_count; i++) {
        if ((option_table[i].uses & command->use) == 0)
            continue;
        left--;
        fputc('.', stream);
        write_name(stream, &option_table[i]);
        fputs(left == 0 ? " .\n" : left == 1 ? "\nand\n" : " ,\n", stream);
    }
}

void write_commands(FILE *stream)
{
    fputs(".Bl -tag -width Ds\n", stream);
    for (size_t i = 0; i < command_count; i++) {
        fputs(".It ", stream);
        write_words_of(stream, &command_table[i]);
        fputc('\n', stream);
        write_sentence(stream, command_table[i].help);
        fputs("It takes the options\n", stream);
        write_taken(stream, &command_table[i]);
    }
    fputs(".El\n", stream);
}

void write_exclusions(FILE *stream)
{
    for (size_t i = 0; i < exclusion_count; i++) {
        char text[EXCLUSION_TEXT_SIZE];
        exclusion_write(&exclusion_table[i], text);
        fputs(".Dl ", stream);
        for (const char *c = text; *c != '\0'; c++)
            fprintf(stream, *c == '-' ? "\\-" : "%c", *c);
        fputc('\n', stream);
    }
}

void write_classes(FILE *stream)
{
    fputs(".Bl -tag -width Ds\n", stream);
    for (size_t i = CLASS_NONE + 1; i < OPTION_CLASSES; i++) {
        fprintf(stream, ".It Bq %s\n", option_class_names[i]);
        write_sentence(stream, option_class_meanings[i]);
    }
    fputs(".El\n", stream);
}

// Writes the window's keys. show_write_keys prints a line for each key, with two spaces between the
// key and its meaning.
void write_keys(FILE *stream)
{
    char text[4096] = "";
    FILE *lines = fmemopen(text, sizeof text, "w");
    if (lines == NULL)
        return;
    show_write_keys(lines);
    fclose(lines);
    if (text[0] == '\0') {
        fputs("This build has no window.\n", stream);
        return;
    }
    fputs(".Bl -tag -width \"middle or Shift drag\" -compact\n", stream);
    char *rest = text;
    for (char *line = strsep(&rest, "\n"); line != NULL; line = strsep(&rest, "\n")) {
        char *gap = strstr(line, "  ");
        if (gap == NULL)
            continue;
        fprintf(stream, ".It Sy \"%.*s\"\n", (int)(gap - line), line);
        write_sentence(stream, gap + 2);
    }
    fputs(".El\n", stream);
}

void write_channels(FILE *stream)
{
    fputs(".Bl -tag -width primitive\n", stream);
    for (size_t i = 0; i < aov_count; i++) {
        fprintf(stream, ".It Cm %s\n", aov_table[i].name);
        write_sentence(stream, aov_table[i].help);
    }
    fputs(".El\n", stream);
}
