// SPDX-License-Identifier: MIT
// Writes a line for each option. Fish offers an option if the command on the line accepts it.
#include "fish.h"

#include "cli/options/option.h"
#include "command_names.h"
#include "value.h"

static void write_quoted(FILE *stream, const char *text)
{
    fputc('\'', stream);
    for (; *text != '\0'; text++)
        fprintf(stream, *text == '\'' || *text == '\\' ? "\\%c" : "%c", *text);
    fputc('\'', stream);
}

// Writes the condition for offering the option: a command that accepts it, or no command if
// rendering accepts it.
static void write_condition(FILE *stream, const Option *option)
{
    fputs(" -n '", stream);
    const char *separator = "";
    if (command_takes(NULL, option)) {
        fputs("not __fish_seen_subcommand_from ", stream);
        command_names_write(stream, " ");
        separator = "; or ";
    }
    for (size_t i = 0; i < command_count; i++)
        if (command_takes(&command_table[i], option)) {
            fprintf(stream, "%s__fish_seen_subcommand_from %s", separator, command_table[i].name);
            separator = "; or ";
        }
    fputc('\'', stream);
}

static void write_option(FILE *stream, const Option *option)
{
    char words[VALUE_WORDS_SIZE];
    const ValueKind kind = value_kind(option, words);
    const bool optional = option_argument_is_optional(option);
    fputs("complete -c clrt", stream);
    write_condition(stream, option);
    if (option->letter != 0)
        fprintf(stream, " -s %c", option->letter);
    fprintf(stream, " -l %s", option->name);
    if (kind == VALUE_WORDS)
        fprintf(stream, optional ? " -f -a '%s'" : " -x -a '%s'", words);
    else if (kind == VALUE_FILE && optional)
        fputs(" -F", stream);
    else if (kind == VALUE_FILE)
        fputs(" -r -F", stream);
    else if (kind == VALUE_OTHER && !optional)
        fputs(" -x", stream);
    fputs(" -d ", stream);
    write_quoted(stream, option->help);
    fputc('\n', stream);
}

void fish_write(FILE *stream)
{
    fputs("# fish completion for clrt, made from its table of options.\n"
          "function __clrt_scenes\n"
          "    __fish_complete_path (commandline -ct) |\n"
          "        string match -r '^[^\\t]*(?:/|\\.scn|\\.ply|\\.obj|\\.stl|\\.glb|\\.gltf|"
          "\\.off|\\.dae|\\.fbx|\\.3ds|\\.pfm|\\.png|\\.exr)(?:\\t.*)?$'\n"
          "end\n"
          "complete -c clrt -f -a '(__clrt_scenes)'\n",
          stream);
    for (size_t i = 0; i < command_count; i++) {
        fprintf(stream, "complete -c clrt -n __fish_is_first_arg -a %s -d ", command_table[i].name);
        write_quoted(stream, command_table[i].help);
        fputc('\n', stream);
    }
    for (size_t i = 0; i < option_count; i++)
        write_option(stream, &option_table[i]);
}
