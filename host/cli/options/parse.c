// SPDX-License-Identifier: MIT
// Parses the command line into Options. getopt splits the command line, option.c parses and stores
// the values, and check.c checks their combination. The message about an unknown option suggests a
// similar one.
#include "cli/options/options.h"

#include "base/text.h"
#include "cli/options/option.h"

#include <assert.h>
#include <getopt.h>
#include <string.h>
#include <unistd.h>

#define FIRST_LONG 256 // getopt returns this plus the row of a long option; larger than any letter

static void fill_getopt(struct option *longs, char *shorts)
{
    *shorts++ = ':';
    for (size_t i = 0; i < option_count; i++) {
        const int kind = option_table[i].argument == NULL                ? no_argument
                         : option_argument_is_optional(&option_table[i]) ? optional_argument
                                                                         : required_argument;
        if (option_key(&option_table[i]) != NULL)
            continue;
        *longs++ = (struct option){option_table[i].name, kind, NULL, FIRST_LONG + (int)i};
        if (option_table[i].letter != 0) {
            *shorts++ = option_table[i].letter;
            if (kind == required_argument)
                *shorts++ = ':';
        }
    }
    *longs = (struct option){0};
    *shorts = '\0';
}

// Options of other programs and of older versions, and the words that clrt suggests instead.
static const struct {
    const char *name, *words;
} synonyms[] = {
    {"samples", "--aa=N"},
    {"spp", "--aa=N"},
    {"width", "--size=WxH"},
    {"height", "--size=WxH"},
    {"resolution", "--size"},
    {"depth", "--max-level"},
    {"bounces", "--max-level"},
    {"camera", "--view"},
    {"explain", "clrt explain SCENE"},
    {"explain-pixel", "clrt explain SCENE X,Y"},
    {"warm", "clrt warm"},
    {"list-devices", "clrt devices"},
    {"kernel", "--tune kernel=FORM"},
    {"nodes", "--tune kernel=FORM"},
    {"lanes", "--tune kernel=FORM:LANES"},
    {"tile", "--tune tile=WxH"},
    {"work-group", "--tune group=WxH"},
    {"specialize", "--tune specialize=WORD"},
    {"bvh", "--tune bvh=WORD"},
    {"no-bvh", "--tune bvh=none"},
    {"quit-after", "--keys=KEYSq"},
    {"expect-hash", "--hash=EXPECTED"},
    {"stats", "--json=FILE"}, // for --stats=FILE; --stats itself takes no value
};

static const char *find_synonym(const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof synonyms / sizeof synonyms[0]; i++)
        if (text_is(name, length, synonyms[i].name))
            return synonyms[i].words;
    return NULL;
}

static bool unknown_option(const char *word, Error *error)
{
    const char *names[OPTIONS_MOST];
    const char *name = word + strspn(word, "-");
    const size_t length = strcspn(name, "=");
    const bool is_long = strncmp(word, "--", 2) == 0;
    for (size_t i = 0; i < option_count; i++)
        names[i] = option_table[i].name;
    const char *nearest = is_long ? word_nearest(name, length, names, option_count) : NULL;
    const char *synonym = is_long ? find_synonym(name, length) : NULL;
    if (synonym != NULL)
        return error_set(error, "unknown option '%s', perhaps %s", word, synonym);
    if (nearest != NULL)
        return error_set(error, "unknown option '%s', perhaps --%s", word, nearest);
    return error_set(error, "unknown option '%s'; clrt --help lists them", word);
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

// Records that the command line contains the option. If a setting is repeated, its last value
// counts. An option for a file may occur only once, because its first file would be ignored.
static bool mark_given(Options *options, size_t row, Error *error)
{
    const Option *option = &option_table[row];
    const uint64_t bit = (uint64_t)1 << row;
    if ((options->given & bit) != 0 && option_names_file(option))
        return error_set(error, "--%s is given twice: name one file", option->name);
    options->given |= bit;
    return true;
}

// Returns the row of the command. If `name` is empty, the options select the row. Otherwise,
// returns the last row of this name that requires at most `count` operands. If all rows of this
// name require more operands, returns the first of these rows. Returns NULL for an unknown name.
static const Command *find_command(const Options *options, const char *name, int count)
{
    const unsigned picture = options->output_path != NULL ? FOR_FILE
                             : options->hash              ? FOR_HASH
                                                          : FOR_WINDOW;
    const Command *found = NULL;
    for (size_t i = 0; i < command_count; i++) {
        const Command *command = &command_table[i];
        if (strcmp(command->name, name) == 0 && (name[0] != '\0' || command->use == picture) &&
            (found == NULL || command->least <= count))
            found = command;
    }
    return found;
}

static bool check_count(const Command *command, char **words, int count, Error *error)
{
    char text[COMMAND_TEXT_SIZE];
    command_write(command, text);
    if (count < command->least)
        return error_set(
            error, "a name is missing: the usage is %s [options]; clrt --help lists them", text);
    if (count == 2 && command->action == ACTION_VIEW && image_format_of_path(words[1]) != NULL)
        return error_set(error, "to write the picture '%s', give -o %s", words[1], words[1]);
    return count <= command->most ||
           error_set(error,
                     "'%s' is one name too many: the usage is %s [options] (optional values follow "
                     "an equals sign, as in --json=FILE)",
                     words[command->most], text);
}

static bool read_operands(Options *options, char **words, int count, Error *error)
{
    if (options->action == ACTION_MERGE) {
        options->part_paths = words;
        options->part_count = count;
        return true;
    }
    options->scene_path = count > 0 ? words[0] : NULL;
    if (options->action == ACTION_EXPLAIN)
        return set_pixel(options, words[1], error);
    options->other_path = count > 1 ? words[1] : NULL;
    return true;
}

static bool is_command(const char *word)
{
    size_t i = 0;
    while (i < command_count && strcmp(command_table[i].name, word) != 0)
        i++;
    return i < command_count;
}

static const char *nearest_command(const char *word)
{
    const char *names[COMMANDS_MOST];
    for (size_t i = 0; i < command_count; i++)
        names[i] = command_table[i].name;
    return word_nearest(word, strlen(word), names, command_count);
}

// Fails if the first name is probably meant as a command: it is neither a file nor looks like one,
// and it is `help`, or resembles a command, or other names follow.
static bool check_command(char **words, int count, Error *error)
{
    if (count == 0 || strpbrk(words[0], "./") != NULL || access(words[0], F_OK) == 0)
        return true;
    const char *nearest = nearest_command(words[0]);
    if (nearest != NULL)
        return error_set(error, "there is no command '%s', perhaps %s", words[0], nearest);
    if (count == 1 && strcmp(words[0], "help") != 0)
        return true;
    return error_set(error, "there is no command '%s'; clrt --help lists the commands", words[0]);
}

// An option with a fallback takes no value after a space. The function rejects a valid value there,
// as in "--aa 4", unless a file has this name.
static bool check_loose_value(const Option *option, const char *word, Error *error)
{
    Options scratch;
    Error unused = {0};
    return option->fallback == NULL || optarg != NULL || word == NULL || access(word, F_OK) == 0 ||
           !option_store(option, &scratch, word, &unused) ||
           error_set(error, "the value of --%s follows an equals sign: --%s=%s", option->name,
                     option->name, word);
}

// Returns the argument that getopt_long has rejected. After an unknown letter, optind is the index
// of this argument if the argument has more letters. Otherwise, optind is the next index.
static const char *rejected_word(char **arguments)
{
    const char *before = arguments[optind - 1];
    const size_t length = strlen(before);
    const bool is_letter = optopt > 0 && optopt < FIRST_LONG;
    const bool is_last = before[0] == '-' && length > 1 && before[length - 1] == optopt;
    return is_letter && (optind == 1 || !is_last) ? arguments[optind] : before;
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
        const int found = getopt_long(count, arguments, shorts, longs, NULL);
        if (found == -1)
            return true;
        if (found == ':')
            return error_set(error, "%s wants a value", arguments[optind - 1]);
        if (found == '?')
            return unknown_option(rejected_word(arguments), error);
        const size_t row = option_of(found);
        if (!mark_given(options, row, error) ||
            !option_store(&option_table[row], options, optarg, error) ||
            !check_loose_value(&option_table[row], arguments[optind], error))
            return false;
    }
}

bool options_parse(Options *options, int count, char **arguments, Error *error)
{
    *options = (Options){.picture.view = 1, .repeat = 1};
    if (!read_options(options, count, arguments, error))
        return false;
    if (options->action != ACTION_RENDER)
        return true; // --help and --version ignore the operands
    const bool is_named = optind < count && is_command(arguments[optind]);
    const char *name = is_named ? arguments[optind++] : "";
    char **operands = arguments + optind;
    count -= optind;
    if (!is_named && !check_command(operands, count, error))
        return false;
    const Command *command = find_command(options, name, count);
    options->action = command->action;
    return check_count(command, operands, count, error) &&
           read_operands(options, operands, count, error) && options_check(options, command, error);
}
