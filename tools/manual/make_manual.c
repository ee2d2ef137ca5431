// SPDX-License-Identifier: MIT
// make_manual TEMPLATE: prints the template with parts from the tables in place of %NAMES%.
#include "manual.h"

#include <string.h>

static const struct {
    const char *name;
    WritePart *write;
} parts[] = {
    {"%SYNOPSIS%", write_synopsis},
    {"%COMMANDS%", write_commands},
    {"%OPTIONS%", write_options},
    {"%EXCLUSIONS%", write_exclusions},
    {"%CLASSES%", write_classes},
    {"%CHANNELS%", write_channels},
    {"%KEYS%", write_keys},
    {"%COMMAND_NAMES%", write_command_names},
    {"%OPTION_TABLE%", write_option_table},
};

static void write_line(FILE *stream, const char *line)
{
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const char *found = strstr(line, parts[i].name);
        if (found == NULL)
            continue;
        const char *rest = found + strlen(parts[i].name);
        fprintf(stream, "%.*s", (int)(found - line), line);
        parts[i].write(stream);
        fputs(found == line ? "" : rest, stream); // parts of the man page are whole lines
        return;
    }
    fputs(line, stream);
}

int main(int count, char **words)
{
    char line[1024];
    FILE *template = count == 2 ? fopen(words[1], "r") : NULL;
    if (template == NULL) {
        fputs("usage: make_manual TEMPLATE\n", stderr);
        return 2;
    }
    while (fgets(line, sizeof line, template) != NULL)
        write_line(stdout, line);
    fclose(template);
    return fflush(stdout) == 0 ? 0 : 1;
}
