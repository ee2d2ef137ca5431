// SPDX-License-Identifier: MIT
// Writes lists of options for _arguments: one for rendering, one for each command.
#include "zsh.h"

#include "cli/options/option.h"
#include "command_names.h"
#include "value.h"

#include <string.h>

// Writes text escaped for single quotes and for the brackets of a specification.
static void write_quoted(FILE *stream, const char *text)
{
    for (; *text != '\0'; text++) {
        if (*text == '\'')
            fputs("'\\''", stream);
        else if (strchr("[]:\\", *text) != NULL)
            fprintf(stream, "\\%c", *text);
        else
            fputc(*text, stream);
    }
}

// Writes the text after a name: the help, and the completion of the value.
static void write_rest(FILE *stream, const Option *option)
{
    char words[VALUE_WORDS_SIZE], name[64];
    fputc('[', stream);
    write_quoted(stream, option->help);
    fputc(']', stream);
    const ValueKind kind = value_kind(option, words);
    if (kind == VALUE_NONE)
        return;
    value_name(option, name, sizeof name);
    fputs(option_argument_is_optional(option) ? "::" : ":", stream);
    write_quoted(stream, name);
    if (kind == VALUE_FILE)
        fputs(":_files", stream);
    else if (kind == VALUE_WORDS)
        fprintf(stream, ":(%s)", words);
    else
        fputs(": ", stream);
}

static void write_option(FILE *stream, const Option *option)
{
    const bool has_value = option->argument != NULL;
    const char *long_end = !has_value ? "" : option_argument_is_optional(option) ? "=-" : "=";
    if (option->letter != 0)
        fprintf(stream, "        '(-%c --%s)'{-%c%s,--%s%s}'", option->letter, option->name,
                option->letter, has_value ? "+" : "", option->name, long_end);
    else
        fprintf(stream, "        '--%s%s", option->name, long_end);
    write_rest(stream, option);
    fputs("'\n", stream);
}

static void write_options(FILE *stream, const Command *command)
{
    fprintf(stream, "    %s)\n        options=(\n", command == NULL ? "*" : command->name);
    for (size_t i = 0; i < option_count; i++)
        if (command_takes(command, &option_table[i]))
            write_option(stream, &option_table[i]);
    fputs("        )\n        ;;\n", stream);
}

void zsh_write(FILE *stream)
{
    fputs("#compdef clrt\n"
          "# zsh completion for clrt, made from its table of options.\n"
          "_clrt_scene() {\n"
          "    _files -g '*.(scn|ply|obj|stl|glb|gltf|off|dae|fbx|3ds|pfm|png|exr)(-.)'\n"
          "}\n"
          "\n"
          "_clrt_first() {\n"
          "    local -a commands=(\n",
          stream);
    for (size_t i = 0; i < command_count; i++) {
        fprintf(stream, "        '%s:", command_table[i].name);
        write_quoted(stream, command_table[i].help);
        fputs("'\n", stream);
    }
    fputs("    )\n"
          "    _alternative 'scenes:scene:_clrt_scene' \"commands:command:((${(j: "
          ":)${(qq)commands}}))\"\n"
          "}\n"
          "\n"
          "local -a options\n"
          "local command= word\n"
          "for word in ${words[2,CURRENT-1]}; do\n"
          "    case $word in\n    ",
          stream);
    command_names_write(stream, " | ");
    fputs(") command=$word && break ;;\n"
          "    esac\n"
          "done\n"
          "case $command in\n",
          stream);
    for (size_t i = 0; i < command_count; i++)
        write_options(stream, &command_table[i]);
    write_options(stream, NULL);
    fputs("esac\n"
          "_arguments -s $options '1: :_clrt_first' '*: :_clrt_scene'\n",
          stream);
}
