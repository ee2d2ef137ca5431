// SPDX-License-Identifier: MIT
// clrt compare: reads two pictures, measures their difference and reports it as text and JSON.
// Shares of pixels are numbers from 0 to 1 in JSON and in the lines about limits, and percentages
// in other lines. The limits of --fail determine the exit status.
#include "cli/commands.h"

#include "base/output_file.h"
#include "compare/difference.h"
#include "image/image_file.h"
#include "image/json_file.h"

typedef struct {
    ComparedImages compared;
    Difference difference;
    Causes causes;
    const Limits *limits;
} Comparison;

// Returns whether the difference is within all limits.
static bool comparison_is_kept(const Comparison *comparison)
{
    for (int kind = 0; kind < LIMIT_KINDS; kind++)
        if (comparison->limits->given[kind] &&
            !limit_is_kept(comparison->limits, (LimitKind)kind, &comparison->difference))
            return false;
    return true;
}

// Returns a cause's share of the mean square error, from 0 to 1.
static double share_of(const Comparison *comparison, CauseKind kind)
{
    double sum = 0;
    for (int i = 0; i < CAUSE_KINDS; i++)
        sum += comparison->causes.squares[i];
    return sum > 0 ? comparison->causes.squares[kind] / sum : 0;
}

static json_t *count_json(const Difference *difference, uint64_t count)
{
    return JSON(FIELD("pixels", count), FIELD("share", (double)count / (double)difference->pixels));
}

static json_t *causes_json(const Comparison *comparison)
{
    const Causes *causes = &comparison->causes;
    json_t *all = causes->known ? json_object() : json_null();
    for (int i = 0; causes->known && i < CAUSE_KINDS; i++)
        json_object_set_new(all, cause_names[i],
                            JSON(FIELD("pixels", causes->pixels[i]),
                                 FIELD("mean_square", causes->squares[i]),
                                 FIELD("share", share_of(comparison, (CauseKind)i))));
    return all;
}

static json_t *limits_json(const Comparison *comparison)
{
    const Limits *limits = comparison->limits;
    const Difference *difference = &comparison->difference;
    json_t *all = json_object();
    for (int i = 0; i < LIMIT_KINDS; i++)
        if (limits->given[i])
            json_object_set_new(
                all, limit_names[i],
                JSON(FIELD("limit", limits->values[i]),
                     FIELD("measured", limit_measured((LimitKind)i, difference)),
                     FIELD("kept", limit_is_kept(limits, (LimitKind)i, difference))));
    return all;
}

static json_t *report_json(const Comparison *comparison)
{
    const Difference *difference = &comparison->difference;
    const char *const *paths = comparison->compared.paths;
    json_t *files = json_pack("[oo]", json_file_path(paths[0]), json_file_path(paths[1]));
    json_t *maximum =
        JSON(FIELD("value", difference->maximum), FIELD("x", difference->maximum_x),
             FIELD("y", difference->maximum_y), FIELD("color", difference->maximum_color));
    json_t *hits =
        difference->has_hits ? count_json(difference, difference->wrong_hits) : json_null();
    return REPORT(1, FIELD("files", files), FIELD("width", difference->width),
                  FIELD("height", difference->height), FIELD("rmse", difference->rmse),
                  FIELD("psnr", difference_psnr(difference)), FIELD("maximum", maximum),
                  FIELD("off_by_1", count_json(difference, difference->off_by_1)),
                  FIELD("off_by_4", count_json(difference, difference->off_by_4)),
                  FIELD("wrong_hits", hits), FIELD("causes", causes_json(comparison)),
                  FIELD("limits", limits_json(comparison)),
                  FIELD("kept", comparison_is_kept(comparison)));
}

static void write_causes(const Comparison *comparison, const json_t *json, FILE *stream)
{
    if (!comparison->causes.known || comparison->difference.maximum <= 0)
        return;
    fputs("of the mean square error:\n", stream);
    for (int i = 0; i < CAUSE_KINDS; i++) {
        if (comparison->causes.pixels[i] == 0)
            continue;
        fprintf(stream, "  %-10s ", cause_names[i]);
        json_print(json_object_get(json, cause_names[i]),
                   "{share 5.1f%} in {pixels} pixels: ", stream);
        fprintf(stream, "%s\n", cause_meanings[i]);
    }
}

static void write_limits(json_t *limits, FILE *stream)
{
    const char *name;
    json_t *limit;
    json_object_foreach(limits, name, limit)
    {
        fprintf(stream, "%s %s ",
                json_is_true(json_object_get(limit, "kept")) ? "kept:" : "BROKEN:", name);
        json_print(limit, "{measured .6g}, the limit is {limit .6g}\n", stream);
    }
}

static void write_text(const Comparison *comparison, FILE *stream)
{
    static const char *const colors[] = {"red", "green", "blue"};
    const Difference *difference = &comparison->difference;
    json_t *json = report_json(comparison);
    json_print(json,
               "{files.0} and {files.1}: {width} x {height} pixels\n"
               "RMSE {rmse .6g} ({rmse .4g%}), PSNR {psnr .4g} dB\n",
               stream);
    if (difference->maximum > 0) {
        json_print(json, "largest difference {maximum.value .6g}, in ", stream);
        fputs(colors[difference->maximum_color], stream);
        json_print(json, " at {maximum.x},{maximum.y}\n", stream);
    } else {
        fputs("all colors are equal\n", stream);
    }
    json_print(json,
               "off by more than 1/255: {off_by_1.pixels} pixels ({off_by_1.share .4g%})\n"
               "off by more than 4/255: {off_by_4.pixels} pixels ({off_by_4.share .4g%})\n",
               stream);
    json_print(json_object_get(json, "wrong_hits"),
               "other primitives hit first: {pixels} pixels ({share .4g%})\n", stream);
    write_causes(comparison, json_object_get(json, "causes"), stream);
    write_limits(json_object_get(json, "limits"), stream);
    json_decref(json);
}

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
    if (options->json_path != NULL &&
        !json_file_write(report_json(comparison), options->json_path, error))
        return EXIT_OUTPUT;
    if (!options->quiet && !options_print_json(options))
        write_text(comparison, stdout);
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
