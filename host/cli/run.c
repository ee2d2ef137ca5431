// SPDX-License-Identifier: MIT
// The stages from a scene file to a session that is ready to draw.
#include "cli/run.h"

#include "base/clock.h"
#include "cli/commands.h"
#include "cli/options/option.h"
#include "cli/progress.h"
#include "image/image_file.h"
#include "scene/scene.h"
#include "scene/scn.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

// The default side of a part's tiles. They are smaller than a picture's, so that each part has more
// tiles and all parts take about equal time.
#define PART_TILE 64

double run_lap(double *moment)
{
    const double before = *moment;
    *moment = clock_seconds();
    return *moment - before;
}

// Completes the request of the options by the scene's size, and resolves it.
static bool resolve(Run *run, Error *error)
{
    const Options *options = run->options;
    const Scene *scene = &run->scene;
    const char *format = options->format != NULL ? options->format : "png";
    ClrtPicture wanted = options->picture;
    if (wanted.width == 0) {
        wanted.width = scene->width;
        wanted.height = scene->height;
    }
    if (wanted.tile_width == 0 && options->parts > 0)
        wanted.tile_width = wanted.tile_height = PART_TILE;
    if (options->fits_level)
        wanted.truncation =
            image_format_half_step(format, options->encoding) / exp2(options->exposure);
    if (!crop_apply(&options->crop, &wanted, error))
        return false;
    const bool is_inside = request_resolve(&wanted, scene, NULL, &run->request);
    assert(is_inside);
    (void)is_inside;
    run->request.settings.part = options->parts > 0 ? options->part - 1 : 0;
    run->request.settings.parts = options->parts;
    run->request.keeps_samples = options->aovs != 0;
    run->report.truncation = truncation_bound(scene, run->request.settings.max_level);
    return true;
}

static bool check_missing(const Options *options, const Scene *scene, Error *error)
{
    const MissingPart missing = scene_missing(scene);
    if (missing.is_fault)
        return error_set(error, "%s: %s", options->scene_path, missing.text);
    if (missing.kind != NULL && !options->quiet)
        fprintf(stderr, "clrt: %s: %s\n", options->scene_path, missing.text);
    return true;
}

bool run_load_scene(Run *run, Error *error)
{
    double moment = clock_seconds();
    const Options *options = run->options;
    bool ok = scene_source_load(&run->scene, options, error);
    const Frames *frames = &options->frames;
    const bool are_views = frames->turntable == 0 && frames->last > 0;
    const uint32_t view = are_views ? frames->last : options->picture.view;
    if (ok && view > run->scene.viewpoints.count)
        ok = error_set(error, "%s has %zu viewpoints, so there is no view %u", options->scene_path,
                       run->scene.viewpoints.count, view);
    run->report.load = run->scene.mesh_seconds;
    run->report.parse = run_lap(&moment) - run->report.load;
    ok = ok && check_geometry(options, &run->scene, error) &&
         check_missing(options, &run->scene, error);
    Error cause = {0};
    if (!session_take(&run->session, &run->scene, &cause) && ok)
        ok = error_set(error, "%s: %s", options->scene_path, cause.text);
    run->report.build = run_lap(&moment);
    return ok && resolve(run, error);
}

static void show_loading(const Options *options, bool begins)
{
    if (progress_on_terminal() && !options->quiet)
        progress_show_loading(begins);
}

SessionSettings run_session_settings(const Options *options)
{
    SessionSettings settings;
    request_settings(&options->renderer, &settings);
    settings.kernel_folder = getenv("CLRT_KERNEL_DIR");
    return settings;
}

void run_begin(Session *session, const Options *options)
{
    session->settings = run_session_settings(options);
    session_begin(session);
}

bool run_await_device(Run *run, Error *error)
{
    const Options *options = run->options;
    const double pictures = options->repeat * (double)frames_count(&options->frames);
    const SessionWork work = session_work(&run->request, pictures);
    return session_await(&run->session, options->action == ACTION_RENDER ? &work : NULL, error);
}

bool run_build_scene(Run *run, Error *error)
{
    double moment = clock_seconds();
    show_loading(run->options, true);
    run->form = session_own_form(&run->session, error);
    show_loading(run->options, false);
    run->report.build += run_lap(&moment);
    if (run->form != NULL)
        run->report.tree = run->form->tree;
    return run->form != NULL;
}

ExitCode run_start(Run *run, Error *error)
{
    run_begin(&run->session, run->options);
    if (!run_load_scene(run, error))
        return EXIT_SCENE;
    return command_files_check(run->options, &run->scene, error) ? EXIT_DONE : EXIT_OUTPUT;
}

ExitCode run_prepare(Run *run, Error *error)
{
    if (!run_await_device(run, error))
        return EXIT_DEVICE;
    if (!run_build_scene(run, error))
        return EXIT_SCENE;
    return EXIT_DONE;
}

void run_free(Run *run)
{
    if (CLRT_TIDY_EXIT)
        session_close(&run->session);
    else
        session_save(&run->session);
    scene_free(&run->scene);
}

// The name of a scene on standard input, in messages. It has no slash, so paths of meshes are
// relative to the current folder. Only the program reads "-" as standard input; to the library, "-"
// is a file name.
#define INPUT_NAME "standard input"

bool scene_source_load(Scene *scene, const Options *options, Error *error)
{
    File file = {0};
    SceneLoadOptions load = options->load;
    load.is_tolerant = options->action == ACTION_CHECK;
    show_loading(options, true);
    const bool ok = options_read_input(options)
                        ? file_read_stream(&file, stdin, INPUT_NAME, error) &&
                              scn_take(scene, &file, INPUT_NAME, &load, error)
                        : scn_load(scene, options->scene_path, &load, error);
    file_free(&file);
    show_loading(options, false);
    return ok;
}
