// SPDX-License-Identifier: MIT
// The setters of OPTION_ODD, in the order of option_table.
#include "cli/options/option.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

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
    const char *end = text + strlen(text);
    return (number_parse(text, end, &options->exposure) == end &&
            fabs(options->exposure) <= EXPOSURE_MOST) ||
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

bool set_expect_hash(Options *options, const char *text, Error *error)
{
    options->expected_hash = text;
    return (strlen(text) == FRAMEBUFFER_HASH_SIZE - 1 &&
            strspn(text, "0123456789abcdefABCDEF") == FRAMEBUFFER_HASH_SIZE - 1) ||
           error_set(error, "--expect-hash wants %d hexadecimal digits, not '%s'",
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
    const char *end = text + strlen(text);
    options->fits_level = strcmp(text, "auto") == 0;
    if (options->fits_level)
        return true;
    if (integer_parse(text, end, &options->max_level) == end && options->max_level >= 0 &&
        options->max_level <= MAX_LEVEL_LIMIT)
        return true;
    return error_set(error, "--max-level wants auto or an integer between 0 and %d, not '%s'",
                     MAX_LEVEL_LIMIT, text);
}

bool set_error(Options *options, const char *text, Error *error)
{
    const size_t length = strlen(text);
    const bool is_percent = length > 0 && text[length - 1] == '%';
    const char *end = text + length - is_percent;
    const bool ok = number_parse(text, end, &options->error_goal) == end;
    options->error_goal /= is_percent ? 100 : 1;
    return (ok && options->error_goal > 0 && options->error_goal <= 1) ||
           error_set(error, "--error wants a number above 0 and up to 1, or 100%%, not '%s'", text);
}

bool set_time(Options *options, const char *text, Error *error)
{
    const char *end = text + strlen(text);
    return (number_parse(text, end, &options->time_goal) == end && options->time_goal > 0 &&
            options->time_goal <= TIME_GOAL_MOST) ||
           error_set(error, "--time wants seconds above 0 and up to %d, not '%s'", TIME_GOAL_MOST,
                     text);
}

bool set_no_bvh(Options *options, const char *text, Error *error)
{
    (void)text, (void)error;
    options->uses_bvh = false;
    return true;
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

bool set_list_devices(Options *options, const char *text, Error *error)
{
    options->action = ACTION_LIST_DEVICES;
    options->lists_json = text != NULL && strcmp(text, "json") == 0;
    return text == NULL || options->lists_json || strcmp(text, "text") == 0 ||
           error_set(error, "--list-devices wants text or json, not '%s'", text);
}

bool set_stats(Options *options, const char *text, Error *error)
{
    options->statistics = true;
    options->statistics_path = text;
    return text == NULL || text[0] != '\0' || error_set(error, "--stats= wants the name of a file");
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
    const char *end = text + strlen(text);
    options->reference = true;
    // Each half of the samples makes a picture. The two pictures' difference measures the
    // reference's own error.
    if (integer_parse(text, end, &samples) != end || samples < 2 ||
        samples > REFERENCE_SAMPLES_MAX || samples % 2 != 0)
        return error_set(error,
                         "--reference-samples wants an even number between 2 and %d, not '%s'",
                         REFERENCE_SAMPLES_MAX, text);
    options->reference_samples = (uint32_t)samples;
    return true;
}

bool set_explain_pixel(Options *options, const char *text, Error *error)
{
    int64_t column, row;
    const char *end = text + strlen(text);
    const char *comma = integer_parse(text, end, &column);
    if (comma == NULL || *comma != ',' || integer_parse(comma + 1, end, &row) != end ||
        column < 0 || column >= PICTURE_SIZE_MAX || row < 0 || row >= PICTURE_SIZE_MAX)
        return error_set(error,
                         "--explain-pixel wants X,Y counted from 0, X from the left and Y "
                         "from the top, not '%s'",
                         text);
    options->pixel[0] = (uint32_t)column;
    options->pixel[1] = (uint32_t)row;
    options->action = ACTION_EXPLAIN;
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
    options->json = true;
    options->json_path = text;
    return text == NULL || text[0] != '\0' || error_set(error, "--json= wants the name of a file");
}
