// SPDX-License-Identifier: MIT
// Reads two pictures, measures their difference and reports it. The limits of --fail determine the
// exit status.
#include "cli/commands.h"

#include "base/output_file.h"
#include "compare/difference.h"
#include "image/image_file.h"
#include "image/stored_image.h"

#include <string.h>

typedef struct {
    const Options *options;
    StoredImage images[2];
    ImagePair pair;
    Difference difference;
    Causes causes;
} Comparison;

static bool read_both(Comparison *comparison, Error *error)
{
    ImagePair *pair = &comparison->pair;
    for (int side = 0; side < 2; side++) {
        pair->images[side] = &comparison->images[side];
        pair->paths[side] =
            side == 0 ? comparison->options->scene_path : comparison->options->other_path;
        if (!image_read(&comparison->images[side], pair->paths[side], error))
            return false;
    }
    return image_pair_check(pair, error);
}

static bool measure(Comparison *comparison, Error *error)
{
    const ImagePair *pair = &comparison->pair;
    difference_measure(&comparison->difference, pair);
    causes_find(&comparison->causes, pair);
    if (comparison->options->limits.given[LIMIT_HITS] && !comparison->difference.has_hits)
        return error_set(
            error,
            "%s and %s do not both have a channel '%s', so that a limit on hits cannot "
            "be judged",
            pair->paths[0], pair->paths[1], DIFFERENCE_HITS);
    return true;
}

static bool write_map(const Comparison *comparison, Error *error)
{
    Framebuffer map = {0};
    const Options *options = comparison->options;
    if (options->output_path == NULL)
        return true;
    const ImageSettings settings = {.format = options->format};
    const bool ok = difference_picture_make(&map, &comparison->pair,
                                            !image_format_is_float(options->format), error) &&
                    image_write(&map, options->output_path, &settings, error);
    framebuffer_free(&map);
    return ok;
}

static ExitCode report(const Comparison *comparison, Error *error)
{
    const Options *options = comparison->options;
    const CompareReport whole = {&comparison->pair, &comparison->difference, &comparison->causes,
                                 &options->limits};
    if (options->json_path != NULL && !compare_report_write_json(&whole, options->json_path, error))
        return EXIT_OUTPUT;
    if (!options->quiet && !options_print_json(options))
        compare_report_write_text(&whole, stdout);
    return compare_report_is_kept(&whole) ? EXIT_DONE : EXIT_FAULTS;
}

static ExitCode run(Comparison *comparison, Error *error)
{
    const Options *options = comparison->options;
    if (options->output_path != NULL && !output_file_check(options->output_path, error))
        return EXIT_OUTPUT;
    if (!read_both(comparison, error) || !measure(comparison, error))
        return EXIT_SCENE;
    if (!write_map(comparison, error))
        return EXIT_OUTPUT;
    return report(comparison, error);
}

ExitCode compare_files(const Options *options, Error *error)
{
    Comparison comparison = {.options = options};
    const ExitCode outcome = run(&comparison, error);
    for (int side = 0; side < 2; side++)
        stored_image_free(&comparison.images[side]);
    return outcome;
}
