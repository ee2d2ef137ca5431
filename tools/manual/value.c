// SPDX-License-Identifier: MIT
// The words come from the table of options. Names in capitals stand for any value and are skipped.
// The words of --format are the formats that this build writes, except GIF.
#include "value.h"

#include "image/image_file.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

void value_name(const Option *option, char *name, size_t size)
{
    const char *argument = option->argument;
    if (option_argument_is_optional(option))
        argument += strspn(argument, "[=");
    snprintf(name, size, "%.*s",
             (int)strcspn(argument, option_argument_is_optional(option) ? "]" : ""), argument);
}

// Stores the words of list that do not begin with a capital, separated by blanks.
static void split(char words[VALUE_WORDS_SIZE], const char *list, const char *separators)
{
    size_t end = 0;
    while (*list != '\0') {
        const size_t length = strcspn(list, separators);
        if (!isupper((unsigned char)list[0]))
            end += (size_t)snprintf(words + end, VALUE_WORDS_SIZE - end, "%s%.*s",
                                    end > 0 ? " " : "", (int)length, list);
        list += length;
        list += strspn(list, separators);
    }
}

ValueKind value_kind(const Option *option, char words[VALUE_WORDS_SIZE])
{
    words[0] = '\0';
    if (option->argument == NULL)
        return VALUE_NONE;
    if (strstr(option->argument, "FILE") != NULL)
        return VALUE_FILE;
    const bool is_format = strcmp(option->name, "format") == 0;
    if (!is_format && strchr(option->argument, '|') == NULL)
        return VALUE_OTHER;
    char list[VALUE_WORDS_SIZE];
    value_name(option, list, sizeof list);
    if (is_format) {
        // Without OpenImageIO, advice in parentheses follows the names.
        const char *names = image_format_names();
        snprintf(list, sizeof list, "%.*s", (int)strcspn(names, "("), names);
    }
    split(words, list, is_format ? ", " : "|");
    return VALUE_WORDS;
}
