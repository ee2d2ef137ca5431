// SPDX-License-Identifier: MIT
// Options that would have no effect are refused, so that none is given in vain.
#include "cli/option_check.h"

#include "cli/option_table.h"
#include "cli/scene_source.h"

#include <string.h>

// Returns the first of names, which ends in NULL, that the command line names; NULL for none.
static const char *first_given(const Options *options, const char *const *names)
{
    while (*names != NULL && !option_is_given(options, *names))
        names++;
    return *names;
}

#ifdef CLRT_WITH_WINDOW
static bool check_window(Options *options, Error *error)
{
    static const char *const of_files[] = {
        "format",      "tile", "bad-geometry", "aa-adaptive", "error",
        "time",        "crop", "part",         "resume",      "frames",
        "turntable",   "aov",  "reference",    "repeat",      "reference-samples",
        "no-metadata", "hash", "expect-hash",  NULL};
    const char *refused = first_given(options, of_files);
    options->action = ACTION_VIEW;
    if (options->fits_level)
        refused = "max-level auto";
    if (options->statistics_path != NULL)
        refused = "stats=FILE";
    if (refused != NULL)
        return error_set(error, "--%s is for files: give one with -o FILE%s", refused,
                         options->aovs != 0 ? ".exr" : "");
    return !scene_source_is_input(options) ||
           error_set(error, "the window reads its scene again and again, and standard input "
                            "can be read once: give -o FILE");
}
#else
static bool check_window(Options *options, Error *error)
{
    (void)options;
    return error_set(error, "this build has no window: write the picture with -o FILE");
}
#endif

static bool check_format(Options *options, Error *error)
{
    const char *path = options->output_path;
    if (options->format == NULL)
        options->format =
            strcmp(path, "-") == 0 ? image_format_named("png") : image_format_of_path(path);
    if (options->format == NULL && strcmp(path, "-") == 0)
        options->format = "pfm";
    return options->format != NULL ||
           error_set(error, "%s: the ending names no format; this build writes %s", path,
                     image_format_names());
}

static bool check_certainty(const Options *options, Error *error)
{
    if (!aov_needs(options->aovs, AOV_NEEDS_CERTAINTY))
        return true;
    if (options_are_adaptive(options))
        return error_set(error, "--aov certainty is of the samples of --aa: leave out "
                                "--aa-adaptive, --error and --time");
    return options->kernel.choice.precision == PRECISION_FP32 ||
           error_set(error, "--aov certainty is of pictures in fp32: leave out --precision fp64");
}

static bool check_aovs(const Options *options, Error *error)
{
    if (options_are_adaptive(options) && aov_needs(options->aovs, AOV_NEEDS_TESTS))
        return error_set(error, "--aov boxtests and tritests count a grid of samples: leave out "
                                "--aa-adaptive, --error and --time");
    return options->aovs == 0 || image_format_takes_layers(options->format) ||
           error_set(error, "--aov needs an EXR file (-o FILE.exr): %s holds colors alone",
                     options->format);
}

// What refining does depends on all pixels around.
static bool check_unrefined(const Options *options, const char *name, Error *error)
{
    return !options_are_adaptive(options) ||
           error_set(error,
                     "%s does not go with --aa-adaptive, --error and --time, which refine "
                     "the picture as a whole: give --aa",
                     name);
}

static bool check_part(const Options *options, Error *error)
{
    if (options->parts == 0)
        return true;
    if (!image_format_takes_layers(options->format))
        return error_set(error, "--part needs an EXR file (-o FILE.exr), which clrt merge reads");
    if (!check_unrefined(options, "--part", error))
        return false;
    if (options->reference)
        return error_set(error, "--reference is of whole pictures: leave out --part");
    return !options->no_metadata ||
           error_set(error, "--part needs the metadata: leave out --no-metadata");
}

static bool check_resume(const Options *options, Error *error)
{
    if (!options->resume)
        return true;
    if (strcmp(options->output_path, "-") == 0)
        return error_set(error, "--resume goes on with a file: standard output is none");
    if (!check_unrefined(options, "--resume", error))
        return false;
    return !option_is_given(options, "repeat") ||
           error_set(error, "--repeat times whole pictures: leave out --resume");
}

static bool check_frames(Options *options, Error *error)
{
    const Frames *frames = &options->frames;
    const struct {
        bool is_given;
        const char *sentence;
    } refused[] = {
        {strcmp(options->output_path, "-") == 0, "standard output takes one: give -o FILE"},
        {options->statistics_path != NULL, "--stats=FILE is of one"},
        {options->reference_path != NULL, "--reference=FILE is of one"},
        {options->expected_hash != NULL, "--expect-hash is of one"},
        {options->resume, "--resume is of one: name those that are missing by --frames"},
    };
    if (!frames_are_many(frames))
        return true;
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++)
        if (refused[i].is_given)
            return error_set(error, "--frames and --turntable draw many pictures, and %s",
                             refused[i].sentence);
    if (frames->turntable == 0 && option_is_given(options, "view"))
        return error_set(error, "--frames names the views: leave out --view");
    if (frames->turntable > 0 && frames->last > frames->turntable)
        return error_set(error, "--turntable %u has no picture %u", frames->turntable,
                         frames->last);
    frames_complete(&options->frames);
    return true;
}

static bool check_samples(const Options *options, Error *error)
{
    static const char *const ways_to_sample[] = {"aa", "aa-adaptive", "error", "time"};
    int ways = 0;
    for (size_t i = 0; i < sizeof ways_to_sample / sizeof ways_to_sample[0]; i++)
        ways += option_is_given(options, ways_to_sample[i]);
    return ways <= 1 ||
           error_set(error, "--aa, --aa-adaptive, --error and --time each choose the samples: give "
                            "one");
}

// What float arithmetic is off by, 4e-5 measured, must not weigh beside what is asked for.
#define ERROR_OF_FP64 1.6e-4

static void choose_precision(Options *options)
{
    KernelWish *wish = &options->kernel;
    if (options->error_goal > 0 && options->error_goal < ERROR_OF_FP64 && !wish->family_given &&
        !wish->nodes_given && !option_is_given(options, "precision"))
        wish->choice.precision = PRECISION_FP64;
}

// One thing at most goes to standard output.
static bool check_streams(const Options *options, Error *error)
{
    const bool picture = strcmp(options->output_path, "-") == 0,
               statistics =
                   options->statistics_path != NULL && strcmp(options->statistics_path, "-") == 0;
    if (picture && statistics)
        return error_set(error, "the picture and the statistics cannot both go to standard output");
    return !options->hash || !(picture || statistics) ||
           error_set(error, "the %s and the hash cannot both go to standard output",
                     picture ? "picture" : "statistics");
}

bool options_check_purpose(Options *options, Error *error)
{
    static const char *const of_windows[] = {"keys", "quit-after", NULL};
    const char *path = options->output_path;
    if (!check_samples(options, error))
        return false;
    choose_precision(options);
    if (path == NULL)
        return check_window(options, error);
    if (first_given(options, of_windows) != NULL)
        return error_set(error, "--keys and --quit-after are for the window: leave out -o");
    return check_format(options, error) && check_aovs(options, error) &&
           (!option_is_given(options, "crop") || check_unrefined(options, "--crop", error)) &&
           check_part(options, error) && check_resume(options, error) &&
           check_frames(options, error) && check_certainty(options, error) &&
           check_streams(options, error);
}

bool options_check_compare(Options *options, Error *error)
{
    if (options->output_path == NULL)
        return options->format == NULL ||
               error_set(error,
                         "--format is for the picture of differences: give one with -o FILE");
    const bool json_told =
        options->json && (options->json_path == NULL || strcmp(options->json_path, "-") == 0);
    if (strcmp(options->output_path, "-") == 0 && (json_told || !options->quiet))
        return error_set(error, "the picture and the report cannot both go to standard output");
    return check_format(options, error);
}

bool options_check_merge(Options *options, Error *error)
{
    if (options->output_path == NULL)
        return error_set(error, "clrt merge wants the name of the whole picture: -o FILE");
    return check_format(options, error) && check_streams(options, error);
}
