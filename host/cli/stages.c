// SPDX-License-Identifier: MIT
// Runs the stages from options and a scene file to a session that is ready to draw. All commands
// that trace use these stages, except the window, which has its own.
#include "cli/stages.h"

#include "base/clock.h"
#include "base/print.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "image/image_file.h"
#include "scene/scene.h"
#include "scene/scn.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

// The default side of a tile in pixels, if the picture is divided into parts. With such small
// tiles, each part has many tiles, so all parts take about the same time.
#define PART_TILE 64

double stage_lap(double *moment)
{
    const double before = *moment;
    *moment = clock_seconds();
    return *moment - before;
}

void stage_note(const Options *options, const char *format, ...)
{
    char text[sizeof(Error)];
    if (options->quiet)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    print_text(stderr, "clrt: %s\n", text);
}

SessionSettings stage_settings(const Options *options)
{
    return (SessionSettings){.wanted = options->renderer,
                             .kernel_folder = getenv("CLRT_KERNEL_DIR")};
}

void stage_begin(Session *session, const Options *options)
{
    session->settings = stage_settings(options);
    session_begin(session);
}

static void show_loading(const Options *options, bool begins)
{
    if (progress_on_terminal() && !options->quiet)
        progress_show_loading(begins);
}

// Messages call a scene on standard input by this name. The name has no slash, so paths of meshes
// are relative to the current folder. In the library, "-" is an ordinary file name, because only
// the program reads standard input.
#define INPUT_NAME "standard input"

bool stage_read(Scene *scene, const Options *options, Error *error)
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

static const char *scene_name(const Options *options)
{
    return options_read_input(options) ? INPUT_NAME : options->scene_path;
}

static bool check_view(const Options *options, const Scene *scene, Error *error)
{
    const Frames *frames = &options->frames;
    const bool are_views = frames->turntable == 0 && frames->last > 0;
    const uint32_t view = are_views ? frames->last : options->picture.view;
    return view <= scene->viewpoints.count ||
           error_set(error, "%s: there is no view %u; the last one is %zu", scene_name(options),
                     view, scene->viewpoints.count);
}

static bool check_missing(const Options *options, const Scene *scene, Error *error)
{
    const MissingPart missing = scene_missing(scene);
    if (missing.is_fault)
        return error_set(error, "%s: %s", scene_name(options), missing.text);
    if (missing.kind != NULL)
        stage_note(options, "%s: %s", scene_name(options), missing.text);
    return true;
}

// Prints a note if rounding visibly moves a camera.
static void note_coarse(const Options *options, const SessionScene *scene)
{
    Error note = {0};
    if (!normalization_is_fine(&scene->normalization, scene->scene, &note))
        stage_note(options, "%s: %s", scene_name(options), note.text);
}

bool stage_load(Session *session, Scene *scene, const Options *options, StageSeconds *seconds,
                Error *error)
{
    Error cause = {0};
    double moment = clock_seconds();
    if (!stage_read(scene, options, error) || !check_view(options, scene, error))
        return false;
    seconds->load = scene->mesh_seconds;
    seconds->parse = stage_lap(&moment) - seconds->load;
    if (!check_geometry(options, scene, error) || !check_missing(options, scene, error))
        return false;
    if (!session_scene_take(session, scene, &cause))
        return error_set(error, "%s: %s", scene_name(options), cause.text);
    note_coarse(options, &session->scene);
    seconds->build = stage_lap(&moment);
    return true;
}

ExitCode stage_start(Session *session, Scene *scene, const Options *options, StageSeconds *seconds,
                     Error *error)
{
    stage_begin(session, options);
    if (!stage_load(session, scene, options, seconds, error))
        return EXIT_SCENE;
    return command_files_check(options, scene, error) ? EXIT_DONE : EXIT_OUTPUT;
}

bool stage_request(SessionPicture *request, const Options *options, const Scene *scene,
                   Error *error)
{
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
    const bool is_inside = request_resolve(&wanted, scene, NULL, request);
    assert(is_inside);
    (void)is_inside;
    request->settings.part = options->parts > 0 ? options->part - 1 : 0;
    request->settings.parts = options->parts;
    request->channels = options->aovs;
    return true;
}

const SceneForm *stage_build(Session *session, const Options *options, Error *error)
{
    show_loading(options, true);
    const SceneForm *form = session_scene_own_form(session, error);
    show_loading(options, false);
    return form;
}

ExitCode stage_prepare(Session *session, const Options *options, const SessionWork *work,
                       StageSeconds *seconds, Error *error)
{
    if (!session_await(session, work, error))
        return EXIT_DEVICE;
    double moment = clock_seconds();
    const SceneForm *form = stage_build(session, options, error);
    seconds->build += stage_lap(&moment);
    return form != NULL ? EXIT_DONE : EXIT_SCENE;
}
