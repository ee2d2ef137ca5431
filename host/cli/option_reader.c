// SPDX-License-Identifier: MIT
// A function for each option that is not a choice among words, in the order of the table.
#include "cli/option_reader.h"

#include "base/number.h"
#include "cli/option_value.h"

#include <string.h>

bool read_aa(Options *options, const char *value, Error *error)
{
    options->samples = 2;
    return value == NULL || read_count(value, "aa", SAMPLES_MAX, &options->samples, error);
}

bool read_aa_adaptive(Options *options, const char *value, Error *error)
{
    options->contrast = OPTIONS_CONTRAST;
    return value == NULL || read_part(value, "aa-adaptive", &options->contrast, error);
}

bool read_aov(Options *options, const char *value, Error *error)
{
    if (!aov_read_list(value, &options->aovs, error))
        return false;
    options->reference = options->reference || aov_needs(options->aovs, AOV_NEEDS_REFERENCE);
    return true;
}

bool read_no_metadata(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->no_metadata = true;
    return true;
}

bool read_hash(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->hash = true;
    return true;
}

bool read_expect_hash(Options *options, const char *value, Error *error)
{
    options->expected_hash = value;
    return (strlen(value) == FRAMEBUFFER_HASH_SIZE - 1 &&
            strspn(value, "0123456789abcdefABCDEF") == FRAMEBUFFER_HASH_SIZE - 1) ||
           error_set(error, "--expect-hash wants %d hexadecimal digits, not '%s'",
                     FRAMEBUFFER_HASH_SIZE - 1, value);
}

bool read_explain(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->action = ACTION_EXPLAIN_SCENE;
    return true;
}

bool read_explain_pixel(Options *options, const char *value, Error *error)
{
    int64_t column, row;
    const char *end = value + strlen(value);
    const char *comma = integer_parse(value, end, &column);
    if (comma == NULL || *comma != ',' || integer_parse(comma + 1, end, &row) != end ||
        column < 0 || column >= PICTURE_SIZE_MAX || row < 0 || row >= PICTURE_SIZE_MAX)
        return error_set(error,
                         "--explain-pixel wants X,Y counted from 0, X from the left and Y "
                         "from the top, not '%s'",
                         value);
    options->pixel[0] = (uint32_t)column;
    options->pixel[1] = (uint32_t)row;
    options->action = ACTION_EXPLAIN;
    return true;
}

bool read_error(Options *options, const char *value, Error *error)
{
    const size_t length = strlen(value);
    const bool is_percent = length > 0 && value[length - 1] == '%';
    const char *end = value + length - is_percent;
    const bool ok = number_parse(value, end, &options->error_goal) == end;
    options->error_goal /= is_percent ? 100 : 1;
    return (ok && options->error_goal > 0 && options->error_goal <= 1) ||
           error_set(error, "--error wants a number above 0 and up to 1, or 100%%, not '%s'",
                     value);
}

bool read_time(Options *options, const char *value, Error *error)
{
    const char *end = value + strlen(value);
    return (number_parse(value, end, &options->time_goal) == end && options->time_goal > 0 &&
            options->time_goal <= TIME_GOAL_MOST) ||
           error_set(error, "--time wants seconds above 0 and up to %d, not '%s'", TIME_GOAL_MOST,
                     value);
}

bool read_output(Options *options, const char *value, Error *error)
{
    options->output_path = value;
    return value[0] != '\0' || error_set(error, "--output wants the name of a file");
}

bool read_format(Options *options, const char *value, Error *error)
{
    options->format = image_format_named(value);
    return options->format != NULL ||
           error_set(error, "--format wants one of %s, not '%s'", image_format_names(), value);
}

bool read_view(Options *options, const char *value, Error *error)
{
    return read_count(value, "view", 1000000, &options->view, error);
}

bool read_size(Options *options, const char *value, Error *error)
{
    uint32_t area[2] = {0};
    const bool ok = read_area(value, "size", PICTURE_SIZE_MAX, area, error);
    options->width = area[0];
    options->height = area[1];
    return ok;
}

bool read_crop(Options *options, const char *value, Error *error)
{
    return crop_parse(&options->crop, value) ||
           error_set(error,
                     "--crop wants X0,Y0,X1,Y1, pixels from the upper left corner or parts of the "
                     "sides from 0 to 1, not '%s'",
                     value);
}

bool read_part_of(Options *options, const char *value, Error *error)
{
    int64_t part, parts;
    const char *end = value + strlen(value);
    const char *slash = integer_parse(value, end, &part);
    if (slash == NULL || *slash != '/' || integer_parse(slash + 1, end, &parts) != end ||
        part < 1 || part > parts || parts > PARTS_MAX)
        return error_set(error, "--part wants I/N, I from 1 to N and N up to %d, not '%s'",
                         PARTS_MAX, value);
    options->part = (uint32_t)part;
    options->parts = (uint32_t)parts;
    return true;
}

bool read_resume(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->resume = true;
    return true;
}

bool read_frames(Options *options, const char *value, Error *error)
{
    return frames_parse(&options->frames, value) ||
           error_set(error, "--frames wants A-B or A-B:S, from 1 to %d, not '%s'", FRAMES_MOST,
                     value);
}

bool read_turntable(Options *options, const char *value, Error *error)
{
    return read_count(value, "turntable", FRAMES_MOST, &options->frames.turntable, error);
}

bool read_repeat(Options *options, const char *value, Error *error)
{
    return read_count(value, "repeat", REPEAT_MAX, &options->repeat, error);
}

bool read_tile(Options *options, const char *value, Error *error)
{
    uint32_t area[2] = {0};
    const bool ok = read_area(value, "tile", PICTURE_SIZE_MAX, area, error);
    options->tile_width = area[0];
    options->tile_height = area[1];
    return ok;
}

bool read_group(Options *options, const char *value, Error *error)
{
    uint32_t area[2] = {0};
    const bool ok = read_area(value, "work-group", 1024, area, error);
    options->group_width = area[0];
    options->group_height = area[1];
    return ok;
}

bool read_no_bvh(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->uses_bvh = false;
    return true;
}

bool read_max_level(Options *options, const char *value, Error *error)
{
    const char *end = value + strlen(value);
    options->fits_level = strcmp(value, "auto") == 0;
    if (options->fits_level)
        return true;
    if (integer_parse(value, end, &options->max_level) == end && options->max_level >= 0 &&
        options->max_level <= MAX_LEVEL_LIMIT)
        return true;
    return error_set(error, "--max-level wants auto or an integer between 0 and %d, not '%s'",
                     MAX_LEVEL_LIMIT, value);
}

bool read_device(Options *options, const char *value, Error *error)
{
    (void)error;
    options->device = value;
    return true;
}

bool read_warm(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->action = ACTION_WARM;
    return true;
}

bool read_threads(Options *options, const char *value, Error *error)
{
    return read_count(value, "threads", 4096, &options->threads, error);
}

bool read_stats(Options *options, const char *value, Error *error)
{
    options->statistics = true;
    options->statistics_path = value;
    return value == NULL || value[0] != '\0' ||
           error_set(error, "--stats= wants the name of a file");
}

bool read_reference(Options *options, const char *value, Error *error)
{
    options->reference = true;
    options->reference_path = value;
    return value == NULL || image_format_of_path(value) != NULL ||
           error_set(error, "--reference= wants the name of a picture whose ending is one of %s",
                     image_format_names());
}

bool read_reference_samples(Options *options, const char *value, Error *error)
{
    int64_t samples;
    const char *end = value + strlen(value);
    options->reference = true;
    // Half of them make each of the two pictures whose difference is the reference's own error.
    if (integer_parse(value, end, &samples) != end || samples < 2 ||
        samples > REFERENCE_SAMPLES_MAX || samples % 2 != 0)
        return error_set(error,
                         "--reference-samples wants an even number between 2 and %d, not '%s'",
                         REFERENCE_SAMPLES_MAX, value);
    options->reference_samples = (uint32_t)samples;
    return true;
}

bool read_keys(Options *options, const char *value, Error *error)
{
    (void)error;
    options->keys = value;
    return true;
}

bool read_quit_after(Options *options, const char *value, Error *error)
{
    return read_count(value, "quit-after", 1000000, &options->quit_after, error);
}

bool read_json(Options *options, const char *value, Error *error)
{
    options->json = true;
    options->json_path = value;
    return value == NULL || value[0] != '\0' ||
           error_set(error, "--json= wants the name of a file");
}

bool read_fail(Options *options, const char *value, Error *error)
{
    Error cause = {0};
    return limits_parse(&options->limits, value, &cause) ||
           error_set(error, "--fail %s", cause.text);
}

bool read_quiet(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->quiet = true;
    return true;
}

bool read_verbose(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->verbose = true;
    return true;
}

bool read_help(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->action = ACTION_HELP;
    return true;
}

bool read_version(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->action = ACTION_VERSION;
    return true;
}
