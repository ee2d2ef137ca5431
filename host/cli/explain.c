// SPDX-License-Identifier: MIT
// clrt explain SCENE X,Y: explains a pixel. Text is printed after each sample, and JSON after the
// last sample.
#include "cli/commands.h"
#include "cli/stages.h"

#include "explain/report.h"
#include "image/json_file.h"
#include "session/level.h"

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

ExitCode explain_pixel(const Options *options, Session *session, Scene *scene, Error *error)
{
    Explainer explainer;
    SessionPicture request;
    StageSeconds unused = {0};
    ExitCode code = stage_start(session, scene, options, &unused, error);
    if (code != EXIT_DONE)
        return code;
    if (!stage_request(&request, options, scene, error))
        return EXIT_SCENE;
    if (!has_pixel(options->pixel, &request.settings, error))
        return EXIT_USAGE;
    code = stage_prepare(session, options, NULL, &unused, error);
    if (code != EXIT_DONE)
        return code;
    if (!session_choose_level(session, &request, error))
        return EXIT_DEVICE;
    const ExplainReport report = {.scene_path = options->scene_path,
                                  .scene = scene,
                                  .settings = &request.settings,
                                  .view = options->picture.view,
                                  .pixel = {options->pixel[0], options->pixel[1]},
                                  .encoding = options->encoding};
    if (!explainer_open(&explainer, session, &request.settings, &request.viewpoint, error))
        return EXIT_DEVICE;
    code = explain(&report, &explainer, options, error);
    explainer_close(&explainer);
    return code;
}
