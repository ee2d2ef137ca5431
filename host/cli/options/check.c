// SPDX-License-Identifier: MIT
// Checks combinations of options. clrt rejects most options that would have no effect.
#include "cli/options/option.h"

#include <string.h>

#define NAMES_MOST 9

// Options that exclude each other, regardless of their values.
typedef struct {
    const char *names[NAMES_MOST], *others[NAMES_MOST]; // NULL after the last name
    const char *sentence;                               // a format; %s is the given one of names
} Conflict;

#define REFINES "aa-adaptive", "error", "time"

static const Conflict conflicts[] = {
    {{"quiet"}, {"verbose"}, "--quiet and --verbose contradict each other: give one"},
    {{"aa", REFINES},
     {"aa", REFINES},
     "--aa, --aa-adaptive, --error and --time each choose the samples: give one"},
    {{"crop", "part"},
     {REFINES},
     "--%s does not go with --aa-adaptive, --error and --time, which refine the picture as a "
     "whole: "
     "give --aa"},
    {{"tile"},
     {REFINES},
     "--aa-adaptive, --error and --time draw the picture as a whole: leave out --tile"},
    {{"no-bvh"}, {"bvh"}, "--no-bvh builds no tree: leave out --bvh"},
    {{"part"}, {"no-metadata"}, "--part needs the metadata: leave out --no-metadata"},
    {{"resume"}, {"repeat"}, "--repeat measures whole pictures: leave out --resume"},
    {{"frames", "turntable"},
     {"expect-hash"},
     "--frames and --turntable draw many pictures, and --expect-hash checks one"},
};

// Returns the first of these names that the command line contains, or NULL. Skips the name `but`.
static const char *first_given(const Options *options, const char *const names[NAMES_MOST],
                               const char *but)
{
    for (int i = 0; i < NAMES_MOST && names[i] != NULL; i++)
        if (option_is_given(options, names[i]) && (but == NULL || strcmp(names[i], but) != 0))
            return names[i];
    return NULL;
}

bool options_check_conflicts(const Options *options, Error *error)
{
    for (size_t i = 0; i < sizeof conflicts / sizeof conflicts[0]; i++) {
        const Conflict *conflict = &conflicts[i];
        const char *name = first_given(options, conflict->names, NULL);
        if (name != NULL && first_given(options, conflict->others, name) != NULL)
            return error_set(error, conflict->sentence, name);
    }
    return true;
}

// Returns the table's first given option that is valid for use but not for other, or NULL.
static const char *first_for(const Options *options, unsigned use, unsigned other)
{
    for (size_t i = 0; i < option_count; i++)
        if (option_is_given(options, option_table[i].name) && (option_table[i].uses & use) != 0 &&
            (option_table[i].uses & other) == 0)
            return option_table[i].name;
    return NULL;
}

#ifdef CLRT_WITH_WINDOW
static bool check_window(Options *options, Error *error)
{
    const char *refused = first_for(options, FOR_FILE, FOR_WINDOW);
    options->action = ACTION_VIEW;
    if (options->fits_level)
        refused = "max-level auto";
    if (options->statistics_path != NULL)
        refused = "stats=FILE";
    if (refused != NULL)
        return error_set(error, "--%s is for files: give one with -o FILE%s", refused,
                         options->aovs != 0 ? ".exr" : "");
    return !options_read_input(options) ||
           error_set(error, "the window reads its scene again and again, and standard input "
                            "can be read once: give -o FILE");
}
#else
static bool check_window(Options *options, Error *error)
{
    (void)options;
    return error_set(error, "this build has no window: write the picture with -o FILE, or add the "
                            "window: tools/setup window && tools/render SCENE");
}
#endif

// Without a file, clrt prints the hash of the pixels and writes no picture.
static bool check_hash_alone(Options *options, Error *error)
{
    static const char *const of_files[NAMES_MOST] = {"format", "encode",      "exposure",
                                                     "aov",    "no-metadata", "part",
                                                     "resume", "frames",      "turntable"};
    const char *name = first_given(options, of_files, NULL);
    options->format = "pfm"; // stores the traced pixels
    return name == NULL || error_set(error, "--%s is for files: give one with -o FILE", name);
}

// Advice on film formats that clrt does not write. The name of the film follows.
#define FILM "; for a film, draw -o turn.####.png and run ffmpeg -framerate 20 -i turn.%04d.png "

static bool check_format(Options *options, Error *error)
{
    const char *path = options->output_path;
    if (options->format == NULL)
        options->format =
            strcmp(path, "-") == 0 ? image_format_named("png") : image_format_of_path(path);
    if (options->format == NULL && strcmp(path, "-") == 0)
        options->format = "pfm";
    if (options->format == NULL)
        return error_set(error, "%s: the ending names no format; this build writes %s%s%s", path,
                         image_format_names(), frames_are_many(&options->frames) ? FILM : "",
                         frames_are_many(&options->frames) ? path : "");
    options->frames.is_film = strcmp(options->format, "gif") == 0;
    return !options->frames.is_film || frames_are_many(&options->frames) ||
           error_set(error, "a GIF holds the pictures of --turntable or --frames: give one, or "
                            "another format");
}

static bool is_standard_output(const char *path)
{
    return path != NULL && strcmp(path, "-") == 0;
}

// A rule on combinations of options.
typedef struct {
    bool is_broken;
    const char *sentence; // a format; %s is the file's format
} Rule;

static bool check_rules(const Options *options, const Rule *rules, size_t count, Error *error)
{
    size_t i = 0;
    while (i < count && !rules[i].is_broken)
        i++;
    return i == count || error_set(error, rules[i].sentence, options->format);
}

#define CHECK_RULES(rules) check_rules(options, rules, sizeof rules / sizeof rules[0], error)

static bool check_file(const Options *options, Error *error)
{
    const bool is_adaptive = options_are_adaptive(options);
    const bool takes_layers = image_format_takes_layers(options->format);
    const bool is_certain = aov_needs(options->aovs, AOV_NEEDS_CERTAINTY);
    const char *reference = options->reference_path;
    const bool are_floats =
        image_format_is_float(options->format) &&
        (reference == NULL || image_format_is_float(image_format_of_path(reference)));
    const Rule rules[] = {
        {options->exposure != 0 && are_floats,
         "--exposure is for 8-bit files: %s holds the traced colors"},
        {options->encoding != ENCODE_RAW && are_floats && options->parts == 0,
         "--encode srgb is for 8-bit files: %s holds the traced colors"},
        {is_adaptive && aov_needs(options->aovs, AOV_NEEDS_TESTS),
         "--aov boxtests and tritests count a grid of samples: leave out --aa-adaptive, --error "
         "and --time"},
        {options->aovs != 0 && !takes_layers,
         "--aov needs an EXR file (-o FILE.exr): %s holds colors alone"},
        {options->parts > 0 && !takes_layers,
         "--part needs an EXR file (-o FILE.exr), which clrt merge reads"},
        {options->parts > 0 && options->reference,
         "--reference measures whole pictures: leave out --part"},
        {options->resume && is_adaptive,
         "--resume does not go with --aa-adaptive, --error and --time, which refine the picture as "
         "a whole: give --aa"},
        {options->resume && is_standard_output(options->output_path),
         "--resume needs a file: give -o FILE"},
        {is_certain && is_adaptive, "--aov certainty certifies the samples of --aa: leave out "
                                    "--aa-adaptive, --error and --time"},
        {is_certain && options->kernel.precision != PRECISION_FP32,
         "--aov certainty certifies pictures in fp32: leave out --precision fp64"},
    };
    return CHECK_RULES(rules);
}

#define MANY "--frames and --turntable draw many pictures, and "

static bool check_frames(Options *options, Error *error)
{
    const Frames *frames = &options->frames;
    const Rule rules[] = {
        {is_standard_output(options->output_path), MANY "standard output takes one: give -o FILE"},
        {options->statistics_path != NULL, MANY "--stats=FILE describes one"},
        {options->reference_path != NULL, MANY "--reference=FILE holds one"},
        {options->resume && frames->is_film,
         MANY "--resume wants a file for each: give another format"},
        {frames->turntable == 0 && option_is_given(options, "view"),
         "--frames names the views: leave out --view"},
    };
    if (!frames_are_many(frames))
        return true;
    if (!CHECK_RULES(rules))
        return false;
    if (frames->turntable > 0 && frames->last > frames->turntable)
        return error_set(error, "--turntable %u has no picture %u", frames->turntable,
                         frames->last);
    options->frames.skips_finished = options->resume;
    options->resume = false;
    return frames_complete(&options->frames, error);
}

// Error goals below this limit select fp64. The limit is four times fp32's measured error, 4e-5.
#define ERROR_OF_FP64 1.6e-4

static void choose_precision(Options *options)
{
    KernelRequest *kernel = &options->kernel;
    if (options->error_goal > 0 && options->error_goal < ERROR_OF_FP64 && kernel->family == 0 &&
        kernel->nodes == 0 && kernel->lanes == 0 && !option_is_given(options, "precision"))
        kernel->precision = PRECISION_FP64;
}

// Fails if several outputs go to standard output.
static bool check_streams(const Options *options, Error *error)
{
    const bool picture = is_standard_output(options->output_path),
               statistics = is_standard_output(options->statistics_path);
    if (picture && statistics)
        return error_set(error, "the picture and the statistics cannot both go to standard output");
    return !options->hash || !(picture || statistics) ||
           error_set(error, "the %s and the hash cannot both go to standard output",
                     picture ? "picture" : "statistics");
}

bool options_check_purpose(Options *options, Error *error)
{
    const bool has_file = options->output_path != NULL;
    choose_precision(options);
    if (!has_file && !options->hash && options->expected_hash == NULL)
        return check_window(options, error);
    if (first_for(options, FOR_WINDOW, FOR_FILE) != NULL)
        return error_set(error, "--keys and --quit-after are for the window: leave out %s",
                         has_file ? "-o" : "--hash and --expect-hash");
    return (has_file ? check_format(options, error) : check_hash_alone(options, error)) &&
           check_frames(options, error) && check_file(options, error) &&
           check_streams(options, error);
}

bool options_check_general_kernels(const Options *options, Error *error)
{
    static const char *const of_scenes[NAMES_MOST] = {"bvh", "no-bvh", "specialize"};
    const char *name = first_given(options, of_scenes, NULL);
    if (name != NULL)
        return error_set(error, "--%s chooses kernels for a scene: name one", name);
    return kernel_check_request(&options->kernel, error);
}

bool options_check_compare(Options *options, Error *error)
{
    if (options->output_path == NULL)
        return options->format == NULL ||
               error_set(error,
                         "--format is for the picture of differences: give one with -o FILE");
    if (is_standard_output(options->output_path) &&
        (options_print_json(options) || !options->quiet))
        return error_set(error, "the picture and the report cannot both go to standard output");
    return check_format(options, error);
}

bool options_check_merge(Options *options, Error *error)
{
    if (options->output_path == NULL)
        return error_set(error, "clrt merge wants the name of the whole picture: -o FILE");
    return check_format(options, error) && check_streams(options, error);
}
