// SPDX-License-Identifier: MIT
// clrt check: reads the scene, examines its geometry, casts rays to find leaks if there is a
// device, and writes a report.
#include "cli/commands.h"

#include "base/clock.h"
#include "check/census.h"
#include "check/report.h"
#include "cli/stages.h"

#include <stdio.h>
#include <stdlib.h>

static bool count_leaks(Check *check, const Session *session, RayCaster *caster, Error *error)
{
    ThreadPool *pool = thread_pool_open(threads_allowed(session->settings.wanted.threads));
    bool ok = true;
    for (size_t object = 0; ok && object < check->scene->objects.count; object++) {
        const LeakSetting setting = {
            .normalization = &check->normalization,
            .closedness = &check->census.meshes[object].closedness,
            .pool = pool,
            .builder = session_builder(&session->settings.wanted),
            .uses_bvh = session->settings.wanted.tree != CLRT_TREE_NONE,
        };
        const MeshObject *given = &check->scene->objects.data[object];
        if (given->mesh.triangle_count > 0)
            ok = leaks_count(&check->leaks[object], caster, given, &setting, error);
    }
    thread_pool_close(pool);
    return ok;
}

static bool trace_leaks(Check *check, Session *session, Error *error)
{
    RayCaster caster;
    check->leaks = memory_zeroed(check->scene->objects.count, sizeof *check->leaks, error);
    if (check->leaks == NULL || !ray_caster_open(&caster, session, RAYS_NEAREST, error))
        return false;
    const bool ok = count_leaks(check, session, &caster, error);
    ray_caster_close(&caster);
    return ok;
}

// Casts rays to find leaks. A missing device is an error only if the options name a device or fp64.
// Otherwise, the report contains only the other checks.
static bool find_leaks(Check *check, Session *session, const Options *options, Error *error)
{
    Error cause = {0};
    if (scene_triangle_count(check->scene) == 0)
        return true;
    stage_begin(session, options);
    if (session_await(session, NULL, &cause) && trace_leaks(check, session, &cause))
        check->device = session->device.name;
    else if (options->renderer.device != NULL || options->renderer.precision == CLRT_FP64)
        return error_set(error, "%s", cause.text);
    else {
        free(check->leaks);
        check->leaks = NULL;
        check->device_fault = cause;
    }
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
    check->normalization = normalization_of(scene);
    normalization_check(&check->normalization, scene, &check->scale_fault);
    if (!census_take(&check->census, scene, &check->normalization, error))
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
    free(check.findings.data);
    free(check.leaks);
    census_free(&check.census);
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
