// SPDX-License-Identifier: MIT
// Words what --help shows.
#include "cli/option_help.h"

#include "cli/option_table.h"
#include "cli/show.h"

static void write_channels(FILE *stream)
{
    fprintf(stream, "\nChannels of --aov, of the ray through each pixel's center where not said "
                    "otherwise:\n");
    for (size_t i = 0; i < aov_count; i++)
        fprintf(stream, "  %-10s %s\n", aov_table[i].name, aov_table[i].help);
}

void options_write_help(FILE *stream)
{
    fprintf(stream,
            "Usage: clrt SCENE [options]\n"
            "       clrt SCENE -o FILE [options]\n"
            "       clrt check SCENE [options]\n"
            "       clrt --warm [SCENE] [options]\n"
            "Traces a scene (.scn, or a .ply mesh) with OpenCL, in a window or to a file; check\n"
            "looks for what is wrong in its geometry instead.\n\n");
    for (size_t i = 0; i < option_count; i++) {
        char name[64], letter[8] = "    ";
        const Option *option = &option_table[i];
        if (option->letter != 0)
            snprintf(letter, sizeof letter, "-%c, ", option->letter);
        const bool separate = option->argument != NULL && !option_argument_is_optional(option);
        snprintf(name, sizeof name, "--%s%s%s", option->name, separate ? " " : "",
                 option->argument == NULL ? "" : option->argument);
        fprintf(stream, "  %s%-20s %s\n", letter, name, option->help);
    }
    write_channels(stream);
    show_write_keys(stream);
    fprintf(stream, "\nExit status: 0 done, 1 check found faults, 2 usage, 3 scene or mesh, "
                    "4 device, 5 output,\n"
                    "             128 + signal when stopped.\n");
}
