// SPDX-License-Identifier: MIT
// The table of options and a function for each kind of value.
#include "cli/options.h"

#include "base/number.h"
#include "base/word.h"
#include "cli/command.h"
#include "cli/option_check.h"
#include "cli/option_choice.h"
#include "cli/option_value.h"
#include "cli/show.h"

#include <assert.h>
#include <getopt.h>
#include <string.h>

static bool read_aa(Options *options, const char *value, Error *error)
{
    options->samples = 2;
    return value == NULL || read_count(value, "aa", SAMPLES_MAX, &options->samples, error);
}

static bool read_output(Options *options, const char *value, Error *error)
{
    options->output_path = value;
    return value[0] != '\0' || error_set(error, "--output wants the name of a file");
}

static bool read_format(Options *options, const char *value, Error *error)
{
    options->format = image_format_named(value);
    return options->format != NULL ||
           error_set(error, "--format wants one of %s, not '%s'", image_format_names(), value);
}

static bool read_view(Options *options, const char *value, Error *error)
{
    return read_count(value, "view", 1000000, &options->view, error);
}

static bool read_size(Options *options, const char *value, Error *error)
{
    uint32_t area[2] = {0};
    const bool ok = read_area(value, "size", PICTURE_SIZE_MAX, area, error);
    options->width = area[0];
    options->height = area[1];
    return ok;
}

static bool read_frames(Options *options, const char *value, Error *error)
{
    return read_count(value, "frames", FRAMES_MAX, &options->frames, error);
}

static bool read_tile(Options *options, const char *value, Error *error)
{
    uint32_t area[2] = {0};
    const bool ok = read_area(value, "tile", PICTURE_SIZE_MAX, area, error);
    options->tile_width = area[0];
    options->tile_height = area[1];
    return ok;
}

static bool read_group(Options *options, const char *value, Error *error)
{
    uint32_t area[2] = {0};
    const bool ok = read_area(value, "work-group", 1024, area, error);
    options->group_width = area[0];
    options->group_height = area[1];
    return ok;
}

static bool read_no_bvh(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->uses_bvh = false;
    return true;
}

static bool read_max_level(Options *options, const char *value, Error *error)
{
    const char *end = value + strlen(value);
    if (integer_parse(value, end, &options->max_level) == end && options->max_level >= 0 &&
        options->max_level <= MAX_LEVEL_LIMIT)
        return true;
    return error_set(error, "--max-level wants an integer between 0 and %d, not '%s'",
                     MAX_LEVEL_LIMIT, value);
}

static bool read_device(Options *options, const char *value, Error *error)
{
    (void)error;
    options->device = value;
    return true;
}

static bool read_list_devices(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->action = ACTION_LIST_DEVICES;
    return true;
}

static bool read_warm(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->action = ACTION_WARM;
    return true;
}

static bool read_threads(Options *options, const char *value, Error *error)
{
    return read_count(value, "threads", 4096, &options->threads, error);
}

static bool read_stats(Options *options, const char *value, Error *error)
{
    options->statistics = true;
    options->statistics_path = value;
    return value == NULL || value[0] != '\0' ||
           error_set(error, "--stats= wants the name of a file");
}

static bool read_keys(Options *options, const char *value, Error *error)
{
    (void)error;
    options->keys = value;
    return true;
}

static bool read_quit_after(Options *options, const char *value, Error *error)
{
    return read_count(value, "quit-after", 1000000, &options->quit_after, error);
}

static bool read_json(Options *options, const char *value, Error *error)
{
    options->json = true;
    options->json_path = value;
    return value == NULL || value[0] != '\0' ||
           error_set(error, "--json= wants the name of a file");
}

static bool read_quiet(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->quiet = true;
    return true;
}

static bool read_verbose(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->verbose = true;
    return true;
}

static bool read_help(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->action = ACTION_HELP;
    return true;
}

static bool read_version(Options *options, const char *value, Error *error)
{
    (void)value, (void)error;
    options->action = ACTION_VERSION;
    return true;
}

// An argument in brackets may be left out, and is then given with '=' alone.
static const struct {
    const char *name;
    char letter; // 0 without a short form
    const char *argument;
    ReadValue *read;
    const char *help;
} table[] = {
    {"output", 'o', "FILE", read_output,
     "write the picture; its ending tells the format; - is standard output"},
    {"format", 0, "NAME", read_format,
     "write this format, whatever the ending (png for standard output)"},
    {"size", 's', "WxH", read_size, "size of the picture in pixels (the scene's, or 512x512)"},
    {"view", 0, "N", read_view,
     "look through the scene's N-th camera (1); without any, the course's six"},
    {"aa", 0, "[=N]", read_aa, "anti-alias with N x N samples a pixel (2)"},
    {"max-level", 0, "N", read_max_level, "rays of level N see the background (the scene's, or 3)"},
    {"bvh", 0, "KIND", read_bvh, "build the tree by sah (default) or midpoint"},
    {"no-bvh", 0, NULL, read_no_bvh, "test every triangle instead"},
    {"device", 0, "SPEC", read_device,
     "OpenCL device: PLATFORM:DEVICE, cpu, gpu or part of a name"},
    {"list-devices", 0, NULL, read_list_devices, "list the OpenCL devices"},
    {"threads", 'j', "N", read_threads, "threads of a CPU device (all that the process may use)"},
    {"tile", 0, "WxH", read_tile, "size of the tiles that the picture is traced in (128x128)"},
    {"work-group", 0, "WxH", read_group, "size of the device's work-groups (8x8; 2x2 packets)"},
    {"specialize", 0, "WHEN", read_specialize,
     "compile kernels for the scene: auto (default), always or never"},
    {"kernel", 0, "KIND", read_kernel,
     "trace rays one by one or packets of 4x4 pixels: auto (default), ray or packet"},
    {"nodes", 0, "KIND", read_nodes,
     "nodes of two children or of eight: auto (default), pair or wide"},
    {"lanes", 0, "N", read_lanes, "width of the kernels' vectors: auto (default), 4, 8 or 16"},
    {"precision", 0, "KIND", read_precision,
     "arithmetic: fp32 (default), or fp64, the reference, with rays one by one and pairs"},
    {"frames", 0, "N", read_frames,
     "draw the picture N times, for timing: -v and --stats=FILE tell each (1)"},
    {"warm", 0, NULL, read_warm,
     "compile the kernels ahead, and those for SCENE where one is named; draw nothing"},
    {"stats", 0, "[=FILE]", read_stats,
     "count rays and tests; as JSON with a FILE (- is standard output); time the window's frames"},
    {"encode", 0, "KIND", read_encode, "8-bit files: raw values (default) or srgb"},
    {"keys", 0, "KEYS", read_keys,
     "press these keys in the window, each once the one before is shown"},
    {"quit-after", 0, "N", read_quit_after,
     "close the window after N frames, counted once the keys are played"},
    {"bad-geometry", 0, "WHAT", read_bad_geometry,
     "triangles of no area: drop (default) or fail, naming the first"},
    {"json", 0, "[=FILE]", read_json, "clrt check: write the report as JSON, to FILE or instead"},
    {"quiet", 'q', NULL, read_quiet, "say nothing but errors"},
    {"verbose", 'v', NULL, read_verbose, "say what is done and with what"},
    {"version", 0, NULL, read_version, "print the version"},
    {"help", 'h', NULL, read_help, "print this"},
};
#define OPTION_COUNT (sizeof table / sizeof table[0])
#define FIRST_LONG   256 // getopt's values of options: past the letters
_Static_assert(OPTION_COUNT <= 64, "options_parse keeps a bit for each");

static bool argument_is_optional(size_t option)
{
    return table[option].argument != NULL && table[option].argument[0] == '[';
}

void options_write_help(FILE *stream)
{
    fprintf(stream,
            "Usage: clrt SCENE [options]\n"
            "       clrt SCENE -o FILE [options]\n"
            "       clrt check SCENE [options]\n"
            "       clrt --warm [SCENE] [options]\n"
            "Traces a scene (.scn, or a .ply mesh) with OpenCL, in a window or to a file; check\n"
            "looks for what is wrong in its geometry instead.\n\n");
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        char name[64], letter[8] = "    ";
        if (table[i].letter != 0)
            snprintf(letter, sizeof letter, "-%c, ", table[i].letter);
        const bool optional = argument_is_optional(i);
        snprintf(name, sizeof name, "--%s%s%s", table[i].name,
                 table[i].argument == NULL || optional ? "" : " ",
                 table[i].argument == NULL ? "" : table[i].argument);
        fprintf(stream, "  %s%-20s %s\n", letter, name, table[i].help);
    }
    show_write_keys(stream);
    fprintf(stream, "\nExit status: 0 done, 1 check found faults, 2 usage, 3 scene or mesh, "
                    "4 device, 5 output,\n"
                    "             128 + signal when stopped.\n");
}

static void fill_getopt(struct option longs[OPTION_COUNT + 1], char *shorts)
{
    *shorts++ = ':';
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const int kind = table[i].argument == NULL ? no_argument
                         : argument_is_optional(i) ? optional_argument
                                                   : required_argument;
        longs[i] = (struct option){table[i].name, kind, NULL, FIRST_LONG + (int)i};
        if (table[i].letter != 0) {
            *shorts++ = table[i].letter;
            if (kind == required_argument)
                *shorts++ = ':';
        }
    }
    longs[OPTION_COUNT] = (struct option){0};
    *shorts = '\0';
}

static bool unknown_option(const char *word, Error *error)
{
    const char *names[OPTION_COUNT];
    for (size_t i = 0; i < OPTION_COUNT; i++)
        names[i] = table[i].name;
    const char *name = word + strspn(word, "-");
    const char *nearest = word_nearest(name, strcspn(name, "="), names, OPTION_COUNT);
    if (nearest == NULL || strncmp(word, "--", 2) != 0)
        return error_set(error, "unknown option '%s'; clrt --help lists them", word);
    return error_set(error, "unknown option '%s', perhaps --%s", word, nearest);
}

static size_t option_of(int found)
{
    if (found >= FIRST_LONG)
        return (size_t)(found - FIRST_LONG);
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if (table[i].letter == found)
            return i;
    assert(!"getopt returned an option that is not in the table");
    return 0;
}

static bool check_purposes(uint64_t given, const Command *command, Error *error)
{
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if ((given >> i & 1) != 0 && !command_takes(command, table[i].name))
            return command == NULL
                       ? error_set(error, "--%s is for clrt check", table[i].name)
                       : error_set(error, "clrt %s takes no --%s", command->name, table[i].name);
    return true;
}

static bool read_scene(Options *options, int count, char **words, Error *error)
{
    if (optind >= count && options->action == ACTION_WARM)
        return kernel_check_wish(&options->kernel, error);
    if (optind >= count)
        return error_set(error, "no scene is named; clrt --help shows the usage");
    if (optind + 1 < count)
        return error_set(error,
                         "one scene at a time: '%s' comes after '%s' (values of --aa and --stats "
                         "need an equals sign)",
                         words[optind + 1], words[optind]);
    options->scene_path = words[optind];
    return kernel_check_wish(&options->kernel, error) &&
           (options->action != ACTION_RENDER || options_check_purpose(options, error));
}

bool options_parse(Options *options, int count, char **words, Error *error)
{
    struct option longs[OPTION_COUNT + 1];
    char shorts[2 * OPTION_COUNT + 2];
    *options = (Options){.samples = 1,
                         .view = 1,
                         .frames = 1,
                         .max_level = -1,
                         .uses_bvh = true,
                         .tile_width = OPTIONS_TILE,
                         .tile_height = OPTIONS_TILE};
    fill_getopt(longs, shorts);
    opterr = 0;
    optind = 0;
    uint64_t given = 0; // a bit for each option of the table
    for (;;) {
        const char *word = words[optind > 0 ? optind : 1];
        const int found = getopt_long(count, words, shorts, longs, NULL);
        if (found == -1)
            break;
        if (found == ':')
            return error_set(error, "%s wants a value", words[optind - 1]);
        if (found == '?')
            return unknown_option(word != NULL && optind > 1 ? words[optind - 1] : word, error);
        const size_t option = option_of(found);
        given |= (uint64_t)1 << option;
        if (!table[option].read(options, optarg, error))
            return false;
    }
    if (options->action != ACTION_RENDER && options->action != ACTION_WARM)
        return true;
    const Command *command = optind < count ? command_named(words[optind]) : NULL;
    if (command != NULL) {
        optind++;
        options->action = command->action;
    }
    return check_purposes(given, command, error) && read_scene(options, count, words, error);
}
