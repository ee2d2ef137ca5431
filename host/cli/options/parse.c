// SPDX-License-Identifier: MIT
// getopt splits the command line, option.c stores the values, and check.c checks their
// combination.
#include "cli/options/options.h"

#include "base/word.h"
#include "cli/options/option.h"

#include <assert.h>
#include <getopt.h>
#include <string.h>
#include <unistd.h>

#define FIRST_LONG 256 // getopt returns this plus the row of a long option; larger than any letter

static void fill_getopt(struct option longs[OPTIONS_MOST + 1], char *shorts)
{
    *shorts++ = ':';
    for (size_t i = 0; i < option_count; i++) {
        const int kind = option_table[i].argument == NULL                ? no_argument
                         : option_argument_is_optional(&option_table[i]) ? optional_argument
                                                                         : required_argument;
        longs[i] = (struct option){option_table[i].name, kind, NULL, FIRST_LONG + (int)i};
        if (option_table[i].letter != 0) {
            *shorts++ = option_table[i].letter;
            if (kind == required_argument)
                *shorts++ = ':';
        }
    }
    longs[option_count] = (struct option){0};
    *shorts = '\0';
}

// Option names of other programs, with the options of clrt.
static const struct {
    const char *name, *option;
} synonyms[] = {
    {"samples", "aa=N"},      {"spp", "aa=N"},        {"width", "size=WxH"},
    {"height", "size=WxH"},   {"resolution", "size"}, {"depth", "max-level"},
    {"bounces", "max-level"}, {"camera", "view"},
};

static bool unknown_option(const char *word, Error *error)
{
    const char *names[OPTIONS_MOST];
    const char *name = word + strspn(word, "-");
    const size_t length = strcspn(name, "=");
    for (size_t i = 0; i < option_count; i++)
        names[i] = option_table[i].name;
    const char *nearest = word_nearest(name, length, names, option_count);
    for (size_t i = 0; i < sizeof synonyms / sizeof synonyms[0]; i++)
        if (strlen(synonyms[i].name) == length && memcmp(synonyms[i].name, name, length) == 0)
            nearest = synonyms[i].option;
    if (nearest == NULL || strncmp(word, "--", 2) != 0)
        return error_set(error, "unknown option '%s'; clrt --help lists them", word);
    return error_set(error, "unknown option '%s', perhaps --%s", word, nearest);
}

static size_t option_of(int found)
{
    if (found >= FIRST_LONG)
        return (size_t)(found - FIRST_LONG);
    for (size_t i = 0; i < option_count; i++)
        if (option_table[i].letter == found)
            return i;
    assert(!"getopt returned an option that is not in the table");
    return 0;
}

// If a setting is repeated, the last value counts. A second file name is an error, because the
// first file would not be written.
static bool mark_given(Options *options, size_t row, Error *error)
{
    const Option *option = &option_table[row];
    const uint64_t bit = (uint64_t)1 << row;
    if ((options->given & bit) != 0 && option_names_file(option))
        return error_set(error, "--%s is given twice: name one file", option->name);
    options->given |= bit;
    return true;
}

// Rejects options that the command does not take. NULL stands for rendering.
static bool check_purposes(const Options *options, const Command *command, Error *error)
{
    char takers[256];
    if (command != NULL && options->statistics_path != NULL &&
        (command->use & (FOR_WARM | FOR_EXPLAIN)) != 0)
        return error_set(error, "clrt %s takes no --stats=FILE", command->name);
    for (size_t i = 0; i < option_count; i++) {
        const Option *option = &option_table[i];
        if (!option_is_given(options, option->name) || command_takes(command, option))
            continue;
        if (command != NULL)
            return error_set(error, "clrt %s takes no --%s", command->name, option->name);
        command_list_takers(option, takers, sizeof takers);
        return error_set(error, "--%s is for %s", option->name, takers);
    }
    return true;
}

static bool read_two(Options *options, const Command *command, int count, char **arguments,
                     Error *error)
{
    if (optind + 2 != count)
        return error_set(error, "clrt %s wants %s", command->name, command->two_operands);
    options->scene_path = arguments[optind];
    options->other_path = arguments[optind + 1];
    return options->action != ACTION_COMPARE || options_check_compare(options, error);
}

static bool read_parts(Options *options, int count, char **arguments, Error *error)
{
    if (optind >= count)
        return error_set(error, "clrt merge wants the names of all parts of a picture");
    options->part_paths = arguments + optind;
    options->part_count = count - optind;
    return options_check_merge(options, error);
}

static bool read_scene(Options *options, int count, char **arguments, Error *error)
{
    if (options->action == ACTION_LIST_DEVICES)
        return optind == count ||
               error_set(error, "clrt --list-devices takes no '%s'", arguments[optind]);
    if (optind >= count && options->action == ACTION_WARM)
        return options_check_general_kernels(options, error);
    if (optind >= count)
        return error_set(error, "no scene is named; clrt --help shows the usage");
    if (optind + 2 == count && options->action == ACTION_RENDER && options->output_path == NULL &&
        image_format_of_path(arguments[optind + 1]) != NULL)
        return error_set(error, "to write the picture '%s', give -o %s", arguments[optind + 1],
                         arguments[optind + 1]);
    if (optind + 1 < count)
        return error_set(error,
                         "one scene at a time: '%s' comes after '%s' (values of --stats and --json "
                         "follow an equals sign)",
                         arguments[optind + 1], arguments[optind]);
    options->scene_path = arguments[optind];
    return kernel_check_request(&options->kernel, error) &&
           (options->action != ACTION_RENDER || options_check_purpose(options, error));
}

// Rejects a valid value after a space, as in "--aa 4", unless a file has this name.
static bool check_loose_value(const Option *option, const char *word, Error *error)
{
    Options scratch;
    Error unused = {0};
    return option->fallback == NULL || optarg != NULL || word == NULL || access(word, F_OK) == 0 ||
           !option_store(option, &scratch, word, &unused) ||
           error_set(error, "the value of --%s follows an equals sign: --%s=%s", option->name,
                     option->name, word);
}

// Reads all options. Afterwards optind is the index of the first operand.
static bool read_options(Options *options, int count, char **arguments, Error *error)
{
    struct option longs[OPTIONS_MOST + 1];
    char shorts[2 * OPTIONS_MOST + 2];
    fill_getopt(longs, shorts);
    opterr = 0;
    optind = 0;
    for (;;) {
        const char *word = arguments[optind > 0 ? optind : 1];
        const int found = getopt_long(count, arguments, shorts, longs, NULL);
        if (found == -1)
            return options_check_conflicts(options, error);
        if (found == ':')
            return error_set(error, "%s wants a value", arguments[optind - 1]);
        if (found == '?')
            return unknown_option(word != NULL && optind > 1 ? arguments[optind - 1] : word, error);
        const size_t row = option_of(found);
        if (!mark_given(options, row, error) ||
            !option_store(&option_table[row], options, optarg, error) ||
            !check_loose_value(&option_table[row], arguments[optind], error))
            return false;
    }
}

bool options_parse(Options *options, int count, char **arguments, Error *error)
{
    *options = (Options){.samples = 1,
                         .view = 1,
                         .repeat = 1,
                         .reference_samples = REFERENCE_SAMPLES,
                         .max_level = -1,
                         .tile_width = OPTIONS_TILE,
                         .tile_height = OPTIONS_TILE};
    if (!read_options(options, count, arguments, error))
        return false;
    if (command_of_action(options->action) != NULL)
        return check_purposes(options, command_of_action(options->action), error) &&
               read_scene(options, count, arguments, error);
    if (options->action != ACTION_RENDER)
        return true; // --help and --version ignore the rest of the command line
    const Command *command = optind < count ? command_named(arguments[optind]) : NULL;
    if (command != NULL) {
        optind++;
        options->action = command->action;
    }
    if (!check_purposes(options, command, error))
        return false;
    if (options->action == ACTION_MERGE)
        return read_parts(options, count, arguments, error);
    return command != NULL && command->two_operands != NULL
               ? read_two(options, command, count, arguments, error)
               : read_scene(options, count, arguments, error);
}
