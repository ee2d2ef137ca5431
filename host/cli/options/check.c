// SPDX-License-Identifier: MIT
// Checks combinations of options. A combination is rejected if its options exclude each other, or
// if an option would have no effect.
#include "cli/options/option.h"

#include <string.h>

#define REFINES "aa-adaptive", "error", "time"

// These rules do not depend on the values of options.
const Exclusion exclusion_table[] = {
    {{"aa", REFINES}, {NULL}},
    {{"crop", "part", "tune tile"}, {REFINES}},
    {{"part"}, {"reference", "reference-samples", "no-metadata"}},
    {{"resume"}, {"repeat"}},
    {{"frames", "turntable"}, {"json"}},
    {{"quiet", "verbose"}, {NULL}},
};
const size_t exclusion_count = sizeof exclusion_table / sizeof exclusion_table[0];

// Returns the first name in `names` that the command line contains and that is not `but`, or NULL.
static const char *first_given(const Options *options, const char *const names[], const char *but)
{
    for (int i = 0; i < EXCLUSION_NAMES && names[i] != NULL; i++)
        if (option_is_given(options, names[i]) && (but == NULL || strcmp(names[i], but) != 0))
            return names[i];
    return NULL;
}

static bool check_exclusions(const Options *options, Error *error)
{
    for (size_t i = 0; i < exclusion_count; i++) {
        const Exclusion *row = &exclusion_table[i];
        const char *name = first_given(options, row->names, NULL);
        const char *const *others = row->others[0] != NULL ? row->others : row->names;
        const char *other = name != NULL ? first_given(options, others, name) : NULL;
        if (other != NULL)
            return error_set(error, "--%s and --%s exclude each other: give one", name, other);
    }
    return true;
}

static void append_names(char *text, const char *const names[], const char *separator)
{
    for (int i = 0; i < EXCLUSION_NAMES && names[i] != NULL; i++)
        strcat(strcat(strcat(text, i > 0 ? separator : ""), "--"), names[i]);
}

void exclusion_write(const Exclusion *exclusion, char text[EXCLUSION_TEXT_SIZE])
{
    const bool has_others = exclusion->others[0] != NULL;
    strcpy(text, "[");
    append_names(text, exclusion->names, has_others ? ", " : " | ");
    append_names(strcat(text, has_others ? " | " : ""), exclusion->others, ", ");
    strcat(text, "]");
}

// Returns the name of the option for a setting that a RequestFault names.
static const char *option_of_setting(const char *setting)
{
    static const char *const names[][2] = {{"samples", "aa"},
                                           {"contrast", "aa-adaptive"},
                                           {"seconds", "time"},
                                           {"tile", "tune tile"},
                                           {"boxtests or tritests", "aov boxtests,tritests"},
                                           {"certainty", "aov certainty"},
                                           {"fp64", "precision fp64"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i][0], setting) == 0)
            return names[i][1];
    return setting;
}

// Checks the request for a picture by request_check, whose rules are not in the tables of options.
static bool check_request(const Options *options, Error *error)
{
    RequestFault fault;
    ClrtPicture wanted = options->picture;
    wanted.crop_width = options->crop.is_given; // the crop's size depends on the scene
    if (request_check(&wanted, options->aovs, options->renderer.precision, &fault))
        return true;
    if (fault.rule == REQUEST_FP64)
        return error_set(error, "--%s below %g %% needs fp64: leave out --precision fp32",
                         fault.setting, 100 * fault.low);
    return error_set(error, "--%s and --%s exclude each other: give one",
                     option_of_setting(fault.setting), option_of_setting(fault.other));
}

// Returns the first row of command_table that accepts the option.
static const Command *first_taker(const Option *option)
{
    const Command *command = command_table;
    while ((command->use & option->uses) == 0)
        command++;
    return command;
}

static bool check_uses(const Options *options, const Command *command, Error *error)
{
    char text[COMMAND_TEXT_SIZE], taker[COMMAND_TEXT_SIZE];
    for (size_t i = 0; i < option_count; i++) {
        const Option *option = &option_table[i];
        if (!option_is_given(options, option->name) || (option->uses & command->use) != 0)
            continue;
        command_write(command, text);
        command_write(first_taker(option), taker);
        return error_set(error, "%s takes no --%s; %s does", text, option->name, taker);
    }
    return true;
}

static bool check_window(const Options *options, Error *error)
{
#ifdef CLRT_WITH_WINDOW
    if (options->fits_level)
        return error_set(error, "--max-level auto is for files: give one with -o FILE");
    return !options_read_input(options) ||
           error_set(error, "the window reads its scene repeatedly, but standard input "
                            "can be read once: give -o FILE");
#else
    (void)options;
    return error_set(error, "this build has no window: write the picture with -o FILE, or add the "
                            "window: tools/setup window && tools/render SCENE");
#endif
}

// The advice if the format of a film (an animated file) is unsupported. check_format appends the
// output path.
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
    const char *sentence; // a format of printf; %s is the name of the file's format
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
    const bool is_adaptive = goal_is_given(&options->picture);
    const bool takes_layers = image_format_takes_layers(options->format);
    const char *reference = options->reference_path;
    const bool are_floats =
        image_format_is_float(options->format) &&
        (reference == NULL || image_format_is_float(image_format_of_path(reference)));
    const Rule rules[] = {
        {options->exposure != 0 && are_floats,
         "--exposure is for 8-bit files: %s holds the traced colors"},
        {options->encoding != ENCODE_RAW && are_floats && options->parts == 0,
         "--encode srgb is for 8-bit files: %s holds the traced colors"},
        {options->aovs != 0 && !takes_layers,
         "--aov needs an EXR file (-o FILE.exr): %s holds colors alone"},
        {options->parts > 0 && !takes_layers,
         "--part needs an EXR file (-o FILE.exr), which clrt merge reads"},
        {options->resume && is_adaptive,
         "--resume does not go with --aa-adaptive, --error and --time, which refine the picture as "
         "a whole: give --aa"},
        {options->resume && is_standard_output(options->output_path),
         "--resume needs a file: give -o FILE"},
    };
    return CHECK_RULES(rules);
}

#define MANY "--frames and --turntable draw many pictures, and "

static bool check_frames(Options *options, Error *error)
{
    const Frames *frames = &options->frames;
    const Rule rules[] = {
        {is_standard_output(options->output_path), MANY "standard output takes one: give -o FILE"},
        {options->expected_hash != NULL, MANY "--hash=EXPECTED describes one"},
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

static void choose_precision(Options *options)
{
    if (request_needs_fp64(&options->picture) && !option_is_given(options, "precision"))
        options->renderer.precision = CLRT_FP64;
}

static bool check_kernel(const Options *options, Error *error)
{
    return kernel_choice_is_valid(&options->renderer) ||
           error_set(error, "%s traces rays one by one through pair nodes: leave out --tune kernel",
                     option_is_given(options, "precision") ? "--precision fp64"
                                                           : "with this --error, clrt");
}

// Fails if several outputs go to standard output.
static bool check_streams(const Options *options, Error *error)
{
    const bool picture = is_standard_output(options->output_path),
               statistics = is_standard_output(options->json_path),
               hash = options->hash && options->expected_hash == NULL;
    if (picture && statistics)
        return error_set(error, "the picture and the statistics cannot both go to standard output: "
                                "give one a file by -o FILE or --json=FILE");
    return !hash || !(picture || statistics) ||
           error_set(error, "the hash goes to standard output: write the %s to a file",
                     picture ? "picture" : "statistics");
}

static bool check_picture(Options *options, Error *error)
{
    options->picture.statistics = options->picture.statistics || options->json_path != NULL;
    if (options->output_path == NULL)
        options->format = "pfm"; // stores the traced pixels
    else if (!check_format(options, error))
        return false;
    return check_frames(options, error) && check_file(options, error) &&
           check_streams(options, error);
}

static bool check_compare(Options *options, Error *error)
{
    if (options->output_path == NULL)
        return options->format == NULL ||
               error_set(error,
                         "--format is for the picture of differences: give one with -o FILE");
    if (is_standard_output(options->output_path) &&
        (options_print_json(options) || !options->quiet))
        return error_set(error,
                         "the picture and the report cannot both go to standard output: write the "
                         "picture with -o FILE");
    return check_format(options, error);
}

static bool check_merge(Options *options, Error *error)
{
    if (options->output_path == NULL)
        return error_set(error, "clrt merge needs a file for the whole picture: give -o FILE");
    return check_format(options, error) && check_streams(options, error);
}

static bool check_action(Options *options, Error *error)
{
    switch (options->action) {
    case ACTION_VIEW:
        return check_window(options, error);
    case ACTION_RENDER:
        return check_picture(options, error);
    case ACTION_COMPARE:
        return check_compare(options, error);
    case ACTION_MERGE:
        return check_merge(options, error);
    default:
        return true;
    }
}

bool options_check(Options *options, const Command *command, Error *error)
{
    choose_precision(options);
    return check_uses(options, command, error) && check_exclusions(options, error) &&
           check_request(options, error) && check_kernel(options, error) &&
           check_action(options, error);
}
