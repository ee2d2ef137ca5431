// SPDX-License-Identifier: MIT
// Explains a pixel: text is printed sample by sample, and JSON after the last sample.
#include "cli/commands.h"

#include "explain/report.h"
#include "image/json_file.h"

static bool has_pixel(const uint32_t pixel[2], const RenderSettings *settings, Error *error)
{
    return (pixel[0] < settings->width && pixel[1] < settings->height) ||
           error_set(error, "pixel %u,%u: the picture has %u x %u pixels, counted from 0", pixel[0],
                     pixel[1], settings->width, settings->height);
}

static ExitCode explain(const ExplainReport *report, Explainer *explainer, const Options *options,
                        Error *error)
{
    if (options->json_path == NULL)
        return explain_write_text(report, explainer, stdout, error) ? EXIT_DONE : EXIT_DEVICE;
    json_t *json = explain_json(report, explainer, error);
    if (json == NULL)
        return EXIT_DEVICE;
    return json_file_write(json, options->json_path, error) ? EXIT_DONE : EXIT_OUTPUT;
}

ExitCode explain_pixel(Run *run, Error *error)
{
    Explainer explainer;
    const Options *options = run->options;
    ExitCode code = run_start(run, error);
    if (code != EXIT_DONE)
        return code;
    if (!has_pixel(options->pixel, &run->request.settings, error))
        return EXIT_USAGE;
    code = run_prepare(run, error);
    if (code != EXIT_DONE)
        return code;
    const Viewpoint *viewpoint = &run->scene.viewpoints.data[options->picture.view - 1];
    const ExplainReport report = {.scene_path = options->scene_path,
                                  .scene = &run->scene,
                                  .settings = &run->request.settings,
                                  .view = options->picture.view,
                                  .pixel = {options->pixel[0], options->pixel[1]},
                                  .encoding = options->encoding};
    if (!explainer_open(&explainer, &run->session, &run->request.settings, viewpoint, error))
        return EXIT_DEVICE;
    code = explain(&report, &explainer, options, error);
    explainer_close(&explainer);
    return code;
}
