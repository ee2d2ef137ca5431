// SPDX-License-Identifier: MIT
// Parses the arguments of options. Each kind of value has a parser, and values that fit no kind
// have setters. Words that go on after their values, such as 5x, are errors.
#include "cli/options/option.h"

#include "base/number.h"

#include <assert.h>
#include <ctype.h>
#include <string.h>

bool option_argument_is_optional(const Option *option)
{
    return option->argument != NULL && option->argument[0] == '[';
}

const char *option_key(const Option *option)
{
    const char *space = strchr(option->name, ' ');
    return space != NULL ? space + 1 : NULL;
}

bool option_names_file(const Option *option)
{
    return option->argument != NULL && strstr(option->argument, "FILE") != NULL;
}

bool option_is_given(const Options *options, const char *name)
{
    size_t row = 0;
    while (row < option_count && strcmp(option_table[row].name, name) != 0)
        row++;
    assert(row < option_count);
    return (options->given >> row & 1) != 0;
}

static bool read_integer(const char *text, int64_t low, int64_t high, int64_t *number)
{
    const char *end = text + strlen(text);
    return integer_parse(text, end, number) == end && *number >= low && *number <= high;
}

// Reads two integers with a separator between them. Both must be at least `low` and at most `high`.
static bool read_two_integers(const char *text, char separator, int64_t low, int64_t high,
                              int64_t pair[2])
{
    const char *middle = integer_parse(text, text + strlen(text), &pair[0]);
    return middle != NULL && tolower((unsigned char)*middle) == separator && pair[0] >= low &&
           pair[0] <= high && read_integer(middle + 1, low, high, &pair[1]);
}

static bool read_number(const char *text, double low, double high, double *number)
{
    const char *end = text + strlen(text);
    return number_parse(text, end, number) == end && *number >= low && *number <= high;
}

static bool store_count(const Option *option, uint32_t *count, const char *text, Error *error)
{
    int64_t number;
    if (!read_integer(text, 1, option->limit, &number))
        return error_set(error, "--%s wants an integer between 1 and %lld, not '%s'", option->name,
                         (long long)option->limit, text);
    *count = (uint32_t)number;
    return true;
}

static bool store_part(const Option *option, double *part, const char *text, Error *error)
{
    return (read_number(text, 0, 1, part) && *part > 0) ||
           error_set(error, "--%s wants a number above 0 and up to 1, not '%s'", option->name,
                     text);
}

static bool store_area(const Option *option, uint32_t *area, const char *text, Error *error)
{
    int64_t sides[2];
    const bool is_side = read_integer(text, 1, option->limit, &sides[0]);
    if (!read_two_integers(text, 'x', 1, option->limit, sides))
        return error_set(error,
                         "--%s wants WIDTHxHEIGHT, each between 1 and %lld, not '%s'%s%s%s%s",
                         option->name, (long long)option->limit, text, is_side ? ", perhaps " : "",
                         is_side ? text : "", is_side ? "x" : "", is_side ? text : "");
    area[0] = (uint32_t)sides[0];
    area[1] = (uint32_t)sides[1];
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

// Returns the index of a word in a list such as "a|b|c", or -1.
static int find_word(const char *list, const char *text, size_t length)
{
    for (int place = 0; *list != '\0'; place++) {
        const size_t size = strcspn(list, "|");
        if (size == length && memcmp(list, text, length) == 0)
            return place;
        list += size + (list[size] == '|');
    }
    return -1;
}

static bool store_word(const Option *option, int *place, const char *text, Error *error)
{
    *place = find_word(option->argument, text, strlen(text));
    return *place >= 0 || reject_word(option, text, error);
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

bool set_output(Options *options, const char *text, Error *error)
{
    options->output_path = text;
    return text[0] != '\0' || error_set(error, "--output wants the name of a file");
}

bool set_format(Options *options, const char *text, Error *error)
{
    options->format = image_format_named(text);
    return options->format != NULL ||
           error_set(error, "--format wants one of %s, not '%s'", image_format_names(), text);
}

bool set_exposure(Options *options, const char *text, Error *error)
{
    return read_number(text, -EXPOSURE_MOST, EXPOSURE_MOST, &options->exposure) ||
           error_set(error, "--exposure wants stops between -%d and %d, not '%s'", EXPOSURE_MOST,
                     EXPOSURE_MOST, text);
}

bool set_aov(Options *options, const char *text, Error *error)
{
    if (!aov_read_list(text, &options->aovs, error))
        return false;
    options->reference = options->reference || aov_needs(options->aovs, AOV_NEEDS_REFERENCE);
    return true;
}

bool set_hash(Options *options, const char *text, Error *error)
{
    options->hash = true;
    options->expected_hash = text;
    return text == NULL ||
           (strlen(text) == FRAMEBUFFER_HASH_SIZE - 1 &&
            strspn(text, "0123456789abcdefABCDEF") == FRAMEBUFFER_HASH_SIZE - 1) ||
           error_set(error, "--hash= wants %d hexadecimal digits, not '%s'",
                     FRAMEBUFFER_HASH_SIZE - 1, text);
}

bool set_crop(Options *options, const char *text, Error *error)
{
    return crop_parse(&options->crop, text) ||
           error_set(error,
                     "--crop wants X0,Y0,X1,Y1, pixels from the upper left corner or parts of the "
                     "sides from 0 to 1, not '%s'",
                     text);
}

bool set_max_level(Options *options, const char *text, Error *error)
{
    int64_t level = 0;
    options->fits_level = strcmp(text, "auto") == 0;
    if (!options->fits_level && !read_integer(text, 0, MAX_LEVEL_LIMIT, &level))
        return error_set(error, "--max-level wants auto or an integer between 0 and %d, not '%s'",
                         MAX_LEVEL_LIMIT, text);
    const int32_t given = level > 0 ? (int32_t)level : CLRT_LEVEL_NONE;
    options->picture.max_level = options->fits_level ? 0 : given;
    return true;
}

bool set_error(Options *options, const char *text, Error *error)
{
    const size_t length = strlen(text);
    const bool is_percent = length > 0 && text[length - 1] == '%';
    const char *end = text + length - is_percent;
    const bool ok = number_parse(text, end, &options->picture.error) == end;
    options->picture.error /= is_percent ? 100 : 1;
    return (ok && options->picture.error > 0 && options->picture.error <= 1) ||
           error_set(error, "--error wants a number above 0 and up to 1, or 100%%, not '%s'", text);
}

bool set_time(Options *options, const char *text, Error *error)
{
    return (read_number(text, 0, TIME_GOAL_MOST, &options->picture.seconds) &&
            options->picture.seconds > 0) ||
           error_set(error, "--time wants seconds above 0 and up to %d, not '%s'", TIME_GOAL_MOST,
                     text);
}

// Returns the row of a key of --tune, or option_count for an unknown key.
static size_t find_key(const char *key)
{
    size_t row = 0;
    while (row < option_count && (option_key(&option_table[row]) == NULL ||
                                  strcmp(option_key(&option_table[row]), key) != 0))
        row++;
    return row;
}

static bool reject_key(const char *item, Error *error)
{
    char list[128] = "";
    for (size_t i = 0; i < option_count; i++)
        if (option_key(&option_table[i]) != NULL)
            strcat(strcat(list, list[0] != '\0' ? ", " : ""), option_key(&option_table[i]));
    return error_set(error, "--tune wants KEY=VALUE, where KEY is one of %s, not '%s'", list, item);
}

bool set_tune(Options *options, const char *text, Error *error)
{
    for (size_t length;; text += length + 1) {
        char key[64], *value = key;
        length = strcspn(text, ",");
        if (length >= sizeof key)
            return reject_key(text, error);
        memcpy(key, text, length);
        key[length] = '\0';
        strsep(&value, "=");
        const size_t row = find_key(key);
        if (row == option_count || value == NULL)
            return reject_key(text, error);
        options->given |= (uint64_t)1 << row;
        if (!option_store(&option_table[row], options, value, error))
            return false;
        if (text[length] == '\0')
            return true;
    }
}

bool set_kernel(Options *options, const char *text, Error *error)
{
    const size_t length = strcspn(text, ":");
    const int form = find_word("auto|pair|wide|packet", text, length); // as ClrtKernel
    int64_t lanes = 0;
    const bool ok = text[length] == '\0' || read_integer(text + length + 1, 4, 16, &lanes);
    const ClrtSettings named = {.kernel = (ClrtKernel)form, .lanes = (uint32_t)lanes};
    options->renderer.kernel = named.kernel;
    options->renderer.lanes = named.lanes;
    return (form >= 0 && ok && kernel_choice_is_valid(&named)) ||
           error_set(error,
                     "--tune kernel wants auto, pair, wide or packet, and wide or packet may have "
                     "4, 8 or 16 lanes, as in packet:8, not '%s'",
                     text);
}

bool set_frames(Options *options, const char *text, Error *error)
{
    return frames_parse(&options->frames, text, error) ||
           error_set(error,
                     "--frames wants A-B or A-B:S, from 1 to %d, or I/N, auto/N, A-B,I/N or "
                     "A-B,auto/N, not '%s'",
                     FRAMES_MOST, text);
}

bool set_part(Options *options, const char *text, Error *error)
{
    Share share;
    if (!share_parse(&share, text, PARTS_MAX, error))
        return error_set(error,
                         "--part wants I/N or auto/N, I from 1 to N and N up to %d, not '%s'",
                         PARTS_MAX, text);
    options->part = share.index;
    options->parts = share.count;
    return true;
}

bool set_reference(Options *options, const char *text, Error *error)
{
    options->reference = true;
    options->reference_path = text;
    return text == NULL || image_format_of_path(text) != NULL ||
           error_set(error, "--reference= wants the name of a picture whose ending is one of %s",
                     image_format_names());
}

bool set_reference_samples(Options *options, const char *text, Error *error)
{
    int64_t samples;
    options->reference = true;
    // The number must be even, because each half of the samples makes a picture. The difference
    // between the two pictures measures the reference's own error.
    if (!read_integer(text, 2, REFERENCE_SAMPLES_MAX, &samples) || samples % 2 != 0)
        return error_set(error,
                         "--reference-samples wants an even number between 2 and %d, not '%s'",
                         REFERENCE_SAMPLES_MAX, text);
    options->picture.reference_samples = (uint32_t)samples;
    return true;
}

bool set_normals(Options *options, const char *text, Error *error)
{
    double *degrees = &options->load.crease_degrees;
    const char *value = strncmp(text, "smooth=", 7) == 0 ? text + 7 : NULL;
    options->load.normals = strcmp(text, "flat") == 0 ? NORMALS_FLAT : NORMALS_SMOOTH;
    *degrees = CREASE_BY_SHAPE;
    if (value != NULL)
        return read_number(value, 0, 180, degrees) ||
               error_set(error, "--normals smooth= wants degrees from 0 to 180, not '%s'", value);
    return options->load.normals == NORMALS_FLAT || strcmp(text, "smooth") == 0 ||
           error_set(error, "--normals wants flat or smooth, not '%s'", text);
}

bool set_pixel(Options *options, const char *text, Error *error)
{
    int64_t place[2];
    if (!read_two_integers(text, ',', 0, PICTURE_SIZE_MAX - 1, place))
        return error_set(error,
                         "'%s' is no pixel: explain wants X,Y counted from 0, X from the left and "
                         "Y from the top",
                         text);
    options->pixel[0] = (uint32_t)place[0];
    options->pixel[1] = (uint32_t)place[1];
    return true;
}

bool set_fail(Options *options, const char *text, Error *error)
{
    Error cause = {0};
    return limits_parse(&options->limits, text, &cause) ||
           error_set(error, "--fail %s", cause.text);
}

bool set_json(Options *options, const char *text, Error *error)
{
    options->json_path = text != NULL ? text : "-";
    return options->json_path[0] != '\0' || error_set(error, "--json= wants the name of a file");
}
