// SPDX-License-Identifier: MIT
// Writes a completion function that does not need the bash-completion package. Bash splits
// "--name=value" into three words. Optional values complete only after '='.
#include "bash.h"

#include "cli/options/option.h"
#include "command_names.h"
#include "value.h"

static const char head[] =
    "# bash completion for clrt, made from its table of options.\n"
    "_clrt_files() {\n"
    "    compopt -o filenames 2>/dev/null\n"
    "    local file\n"
    "    while IFS= read -r file; do COMPREPLY+=(\"$file\"); done < <(\"$@\")\n"
    "}\n"
    "\n"
    "_clrt() {\n"
    "    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
    "    local option=$before command= word\n"
    "    COMPREPLY=()\n"
    "    if [[ $current == = ]]; then\n"
    "        option=$before= current=\n"
    "    elif [[ $before == = ]]; then\n"
    "        option=${COMP_WORDS[COMP_CWORD - 2]}=\n"
    "    fi\n"
    "    case $option in\n";

static const char middle[] = "    esac\n"
                             "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
                             "        case $word in\n";

static void write_pattern(FILE *stream, const Option *option)
{
    fprintf(stream, "    --%s=", option->name);
    if (!option_argument_is_optional(option))
        fprintf(stream, " | --%s", option->name);
    if (option->letter != 0 && !option_argument_is_optional(option))
        fprintf(stream, " | -%c", option->letter);
    fputs(")\n", stream);
}

static void write_value(FILE *stream, const Option *option)
{
    char words[VALUE_WORDS_SIZE];
    const ValueKind kind = value_kind(option, words);
    if (kind == VALUE_NONE)
        return;
    write_pattern(stream, option);
    if (kind == VALUE_FILE)
        fputs("        _clrt_files compgen -f -- \"$current\"\n", stream);
    else if (kind == VALUE_WORDS)
        fprintf(stream, "        COMPREPLY=($(compgen -W '%s' -- \"$current\"))\n", words);
    fputs("        return\n        ;;\n", stream);
}

static void write_names(FILE *stream, const Command *command)
{
    fprintf(stream, "        %s) words='", command == NULL ? "*" : command->name);
    for (size_t i = 0; i < option_count; i++) {
        if (!command_takes(command, &option_table[i]))
            continue;
        fprintf(stream, "--%s ", option_table[i].name);
        if (option_table[i].letter != 0)
            fprintf(stream, "-%c ", option_table[i].letter);
    }
    fputs("' ;;\n", stream);
}

static void write_commands(FILE *stream)
{
    fputs("        ", stream);
    command_names_write(stream, " | ");
    fputs(") command=$word && break ;;\n"
          "        esac\n"
          "    done\n"
          "    if [[ $current == -* ]]; then\n"
          "        local words\n"
          "        case $command in\n",
          stream);
    for (size_t i = 0; i < command_count; i++)
        write_names(stream, &command_table[i]);
    write_names(stream, NULL);
    fputs("        esac\n"
          "        COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
          "        return\n"
          "    fi\n"
          "    _clrt_files compgen -d -- \"$current\"\n"
          "    for word in scn ply obj stl glb gltf off dae fbx 3ds pfm png exr; do\n"
          "        _clrt_files compgen -f -X \"!*.$word\" -- \"$current\"\n"
          "    done\n"
          "    [[ -n $command ]] || COMPREPLY+=($(compgen -W '",
          stream);
    command_names_write(stream, " ");
    fputs("' -- \"$current\"))\n"
          "}\n"
          "complete -F _clrt clrt\n",
          stream);
}

void bash_write(FILE *stream)
{
    fputs(head, stream);
    for (size_t i = 0; i < option_count; i++)
        write_value(stream, &option_table[i]);
    fputs(middle, stream);
    write_commands(stream);
}
