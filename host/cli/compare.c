// SPDX-License-Identifier: MIT
// clrt compare: reads two pictures, measures their difference and reports it. The limits of --fail
// determine the exit status.
#include "cli/commands.h"

#include "base/output_file.h"
#include "compare/report.h"
#include "image/image_file.h"
#include "image/image_read.h"

static bool measure(Comparison *comparison, Error *error)
{
    ComparedImages *compared = &comparison->compared;
    if (!compared_images_check(compared, error))
        return false;
    difference_measure(&comparison->difference, compared);
    causes_find(&comparison->causes, compared);
    if (comparison->limits->given[LIMIT_HITS] && !comparison->difference.has_hits)
        return error_set(error,
                         "%s and %s do not both have a channel '%s', which a limit on hits needs",
                         compared->paths[0], compared->paths[1], DIFFERENCE_HITS);
    return true;
}

static bool write_map(const Comparison *comparison, const Options *options, Error *error)
{
    Framebuffer map = {0};
    if (options->output_path == NULL)
        return true;
    const ImageSettings settings = {.format = options->format};
    const bool ok = difference_picture_make(&map, &comparison->compared,
                                            !image_format_is_float(options->format), error) &&
                    image_write(&map, options->output_path, &settings, error);
    framebuffer_free(&map);
    return ok;
}

static ExitCode report(const Comparison *comparison, const Options *options, Error *error)
{
    if (options->json_path != NULL && !comparison_write_json(comparison, options->json_path, error))
        return EXIT_OUTPUT;
    if (!options->quiet && !options_print_json(options))
        comparison_write_text(comparison, stdout);
    return comparison_is_kept(comparison) ? EXIT_DONE : EXIT_FAULTS;
}

static ExitCode run(StoredImage images[2], const Options *options, Error *error)
{
    const char *const paths[] = {options->scene_path, options->other_path};
    Comparison comparison = {.compared = {{&images[0], &images[1]}, {paths[0], paths[1]}, {{0}}},
                             .limits = &options->limits};
    if (options->output_path != NULL && !output_file_check(options->output_path, error))
        return EXIT_OUTPUT;
    if (!image_read(&images[0], paths[0], error) || !image_read(&images[1], paths[1], error) ||
        !measure(&comparison, error))
        return EXIT_SCENE;
    if (!write_map(&comparison, options, error))
        return EXIT_OUTPUT;
    return report(&comparison, options, error);
}

ExitCode compare_files(const Options *options, Error *error)
{
    StoredImage images[2] = {0};
    const ExitCode outcome = run(images, options, error);
    stored_image_free(&images[0]);
    stored_image_free(&images[1]);
    return outcome;
}
