// SPDX-License-Identifier: MIT
// Parses the arguments of options. clrt rejects trailing text.
#include "cli/options/option.h"

#include "base/number.h"

#include <string.h>

bool option_argument_is_optional(const Option *option)
{
    return option->argument != NULL && option->argument[0] == '[';
}

bool option_names_file(const Option *option)
{
    return option->argument != NULL && strstr(option->argument, "FILE") != NULL;
}

static bool store_count(const Option *option, uint32_t *count, const char *text, Error *error)
{
    int64_t number;
    const char *end = text + strlen(text);
    if (integer_parse(text, end, &number) != end || number < 1 || number > option->limit)
        return error_set(error, "--%s wants an integer between 1 and %lld, not '%s'", option->name,
                         (long long)option->limit, text);
    *count = (uint32_t)number;
    return true;
}

static bool store_part(const Option *option, double *part, const char *text, Error *error)
{
    const char *end = text + strlen(text);
    return (number_parse(text, end, part) == end && *part > 0 && *part <= 1) ||
           error_set(error, "--%s wants a number above 0 and up to 1, not '%s'", option->name,
                     text);
}

static bool store_area(const Option *option, uint32_t *area, const char *text, Error *error)
{
    int64_t width, height;
    const char *end = text + strlen(text);
    const char *cross = integer_parse(text, end, &width);
    const bool is_side = cross == end && width >= 1 && width <= option->limit;
    if (cross == NULL || *cross != 'x' || integer_parse(cross + 1, end, &height) != end ||
        width < 1 || width > option->limit || height < 1 || height > option->limit)
        return error_set(error,
                         "--%s wants WIDTHxHEIGHT, each between 1 and %lld, not '%s'%s%s%s%s",
                         option->name, (long long)option->limit, text, is_side ? ", perhaps " : "",
                         is_side ? text : "", is_side ? "x" : "", is_side ? text : "");
    area[0] = (uint32_t)width;
    area[1] = (uint32_t)height;
    return true;
}

static bool reject_word(const Option *option, const char *text, Error *error)
{
    char list[128] = "";
    for (const char *word = option->argument; *word != '\0';) {
        const size_t length = strcspn(word, "|");
        strncat(list, word, length);
        word += length + (word[length] == '|');
        if (*word != '\0')
            strcat(list, strchr(word, '|') != NULL ? ", " : " or ");
    }
    return error_set(error, "--%s wants %s, not '%s'", option->name, list, text);
}

static bool store_word(const Option *option, int *place, const char *text, Error *error)
{
    const char *word = option->argument;
    for (*place = 0; *word != '\0'; (*place)++) {
        const size_t length = strcspn(word, "|");
        if (strlen(text) == length && memcmp(word, text, length) == 0)
            return true;
        word += length + (word[length] == '|');
    }
    return reject_word(option, text, error);
}

bool option_store(const Option *option, Options *options, const char *text, Error *error)
{
    void *field = (char *)options + option->offset;
    if (text == NULL)
        text = option->fallback;
    switch (option->kind) {
    case OPTION_FLAG:
        *(bool *)field = true;
        return true;
    case OPTION_ACTION:
        options->action = (Action)option->limit;
        return true;
    case OPTION_COUNT:
        return store_count(option, field, text, error);
    case OPTION_PART:
        return store_part(option, field, text, error);
    case OPTION_AREA:
        return store_area(option, field, text, error);
    case OPTION_WORD:
        return store_word(option, field, text, error);
    case OPTION_TEXT:
        *(const char **)field = text;
        return true;
    case OPTION_ODD:
        break;
    }
    return option->set(options, text, error);
}
