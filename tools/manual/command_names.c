// SPDX-License-Identifier: MIT
// Writes the names in the order of --help.
#include "command_names.h"

#include "cli/options/option.h"

void command_names_write(FILE *stream, const char *separator)
{
    for (size_t i = 0; i < command_count; i++)
        fprintf(stream, "%s%s", i == 0 ? "" : separator, command_table[i].name);
}
