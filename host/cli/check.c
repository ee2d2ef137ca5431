// SPDX-License-Identifier: MIT
// clrt check: reads the scene, examines its geometry, casts rays to find leaks if there is a
// device, and writes a report.
#include "cli/commands.h"

#include "base/clock.h"
#include "check/measure.h"
#include "check/report.h"
#include "cli/stages.h"

#include <stdio.h>

static bool find_leaks(Check *check, Session *session, const Options *options, Error *error)
{
    Error cause = {0};
    if (scene_triangle_count(check->scene) == 0)
        return true;
    stage_begin(session, options);
    if (session_await(session, NULL, &cause) && check_trace(check, session, &cause))
        return true;
    if (options->renderer.device != NULL || options->renderer.precision == CLRT_FP64)
        return error_set(error, "%s", cause.text);
    check->device_fault = cause;
    return true;
}

static ExitCode report(Check *check, const Options *options, Error *error)
{
    if (!check_find(check, error))
        return EXIT_SCENE;
    if (options->json_path != NULL && !check_report_write_json(check, options->json_path, error))
        return EXIT_OUTPUT;
    if (!options->quiet && !options_print_json(options))
        check_report_write_text(check, stdout);
    return check_count_failing(check) > 0 ? EXIT_FAULTS : EXIT_DONE;
}

static void print_notes(const Options *options, const Scene *scene)
{
    for (size_t note = 0; !options->quiet && note < scene->notes.count; note++)
        fprintf(stderr, "clrt: %s\n", scene->notes.data[note]);
}

static ExitCode perform(Check *check, const Options *options, Session *session, Scene *scene,
                        Error *error)
{
    const double start = clock_seconds();
    if (!stage_read(scene, options, error))
        return EXIT_SCENE;
    if (!command_files_check(options, scene, error))
        return EXIT_OUTPUT;
    if (!check_measure(check, error))
        return EXIT_SCENE;
    print_notes(options, scene);
    if (!find_leaks(check, session, options, error))
        return EXIT_DEVICE;
    check->seconds = clock_seconds() - start;
    return report(check, options, error);
}

ExitCode check_scene(const Options *options, Session *session, Scene *scene, Error *error)
{
    Check check = {.scene_path = options->scene_path, .scene = scene};
    const ExitCode outcome = perform(&check, options, session, scene, error);
    check_free(&check);
    return outcome;
}

bool check_geometry(const Options *options, const Scene *scene, Error *error)
{
    Error note = {0};
    if (options->bad_geometry == BAD_GEOMETRY_FAIL)
        return bad_geometry_none(scene, error);
    print_notes(options, scene);
    if (!options->quiet && !bad_geometry_none_dropped(scene, &note))
        fprintf(stderr, "clrt: %s\n", note.text);
    return true;
}
