// SPDX-License-Identifier: MIT
// clrt SCENE -o FILE: renders picture files. On request, clrt also resumes an earlier run,
// certifies the colors, draws channels and measures the error.
#include "cli/commands.h"

#include "base/clock.h"
#include "base/output_file.h"
#include "cli/options/option.h"
#include "cli/picture_error.h"
#include "cli/picture_messages.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/stop.h"
#include "image/image_file.h"
#include "jobs/stored_tiles.h"
#include "scene/camera.h"
#include "session/level.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The context of the render observer.
typedef struct {
    Picture *picture;
    Progress progress;
    Error *error;
} TileWatch;

static bool tile_done(void *context, const RenderProgress *render)
{
    TileWatch *watch = context;
    Picture *picture = watch->picture;
    return resume_keep(&picture->resume, &picture->request.settings, &picture->framebuffer,
                       render->tiles_done - 1, watch->error) &&
           progress_tile_done(&watch->progress, render);
}

static bool draw_once(Picture *picture, Error *error)
{
    double moment = clock_seconds();
    TileWatch watch = {picture, progress_begin(picture->options->quiet), error};
    const RenderObserver observer = {tile_done, &watch};
    const bool ok = session_draw_picture(picture->session, &picture->request, &observer,
                                         &picture->framebuffer, &picture->drawn, error);
    picture->stopped_by = progress_end(&watch.progress);
    const double seconds = stage_lap(&moment);
    if (picture->options->verbose && ok)
        fprintf(stderr, "traced in %.4f s\n", seconds);
    picture->repetition_seconds[picture->repetition_count++] = seconds;
    return ok && !picture->resume.journal.is_broken;
}

static bool draw(Picture *picture, Error *error)
{
    bool ok = true;
    for (uint32_t i = 0; ok && picture->stopped_by == 0 && i < picture->options->repeat; i++)
        ok = draw_once(picture, error);
    picture->complete = ok && picture->drawn.is_complete;
    return ok;
}

// With --aov certainty, computes the certainty of each pixel of a finished picture. If only fp64 is
// exact enough for a pixel, the pixel gets the color that fp64 yields. Does nothing to a picture
// that was stopped.
static bool certify(Picture *picture, Error *error)
{
    double moment = clock_seconds();
    if (!aov_needs(picture->options->aovs, AOV_NEEDS_CERTAINTY) || picture->stopped_by != 0)
        return true;
    Progress progress = progress_begin(picture->options->quiet);
    const RenderObserver observer = {progress_tile_done, &progress};
    const bool ok = session_certify_picture(picture->session, &picture->request, &observer,
                                            &picture->framebuffer, &picture->drawn, error);
    picture->stopped_by = progress_end(&progress);
    picture->complete = picture->complete && picture->stopped_by == 0;
    picture->certainty_seconds = stage_lap(&moment);
    return ok;
}

static bool trace_layers(Picture *picture, Error *error)
{
    Progress progress = progress_begin(picture->options->quiet);
    const RenderObserver observer = {progress_tile_done, &progress};
    const bool ok = session_draw_channels(picture->session, &picture->request, &observer,
                                          &picture->layers, &picture->drawn, error);
    picture->stopped_by = progress_end(&progress);
    picture->complete = picture->complete && picture->stopped_by == 0;
    return ok;
}

// Draws the requested channels. If the picture was stopped, the channels stay zero.
static bool draw_layers(Picture *picture, Error *error)
{
    const Options *options = picture->options;
    const Framebuffer *frame = &picture->framebuffer;
    aov_name_layers(options->aovs, &picture->layers);
    picture_error_name_layer(options, &picture->layers);
    return layers_make(&picture->layers, frame->width, frame->height, error) &&
           (options->aovs == 0 || picture->stopped_by != 0 || trace_layers(picture, error));
}

static bool open_film(Picture *picture, Error *error)
{
    const RenderSettings *settings = &picture->request.settings;
    const uint64_t rows = (uint64_t)frames_count(&picture->options->frames) * settings->height;
    if (rows > INT32_MAX)
        return error_set(error,
                         "the pictures are too many for one GIF: draw fewer or smaller ones, or "
                         "numbered files such as a.####.png");
    const bool ok = framebuffer_make(&picture->film, settings->width, (uint32_t)rows, error);
    picture->film.height = 0;
    return ok;
}

static uint32_t add_to_film(Picture *picture)
{
    Framebuffer *film = &picture->film;
    const Framebuffer *frame = &picture->framebuffer;
    memcpy(film->pixels + (size_t)film->width * film->height, frame->pixels,
           (size_t)frame->width * frame->height * sizeof *frame->pixels);
    film->height += frame->height;
    return film->height / frame->height;
}

static bool write_picture(Picture *picture, Error *error)
{
    Provenance provenance;
    const Options *options = picture->options;
    double moment = clock_seconds();
    const bool is_film = options->frames.is_film;
    framebuffer_hash(&picture->framebuffer, picture->pixel_hash);
    const uint32_t film_frames = is_film ? add_to_film(picture) : 0;
    if (is_film && film_frames < frames_count(&options->frames) && picture->stopped_by == 0)
        return true;
    if (picture->path == NULL) // only the hash is requested
        return true;
    report_fill_provenance(&provenance, picture);
    provenance_list(&provenance);
    ImageSettings settings = {.format = options->format,
                              .encoding = options->encoding,
                              .exposure = options->exposure,
                              .frames = film_frames,
                              .left = picture->request.settings.left,
                              .top = picture->request.settings.top,
                              .whole_width = render_whole_width(&picture->request.settings),
                              .whole_height = render_whole_height(&picture->request.settings),
                              .texts = provenance.list,
                              .text_count = options->no_metadata ? 0 : provenance.count,
                              .layers = picture->layers.count > 0 ? &picture->layers : NULL};
    ImagePart part = {0};
    if (picture->request.settings.parts > 0) {
        settings.part = &part;
        if (!stored_tiles_list(&picture->request.settings, &part, error))
            return false;
        part.tile_count = picture->drawn.progress.tiles_done;
    }
    const bool ok = image_write(is_film ? &picture->film : &picture->framebuffer, picture->path,
                                &settings, error);
    free(part.tiles);
    picture->write_seconds = stage_lap(&moment);
    if (ok && picture->stopped_by == 0)
        picture_print_end(picture);
    return ok;
}

static bool write_statistics(Picture *picture, Error *error)
{
    const Options *options = picture->options;
    picture->total_seconds = clock_seconds() - picture->start;
    if (option_is_given(options, "stats"))
        report_write_text(picture, stderr);
    return options->json_path == NULL || report_write_json(picture, options->json_path, error);
}

// Before any work, checks SOURCE_DATE_EPOCH, and checks whether the outputs can be written and
// resumed.
static ExitCode check_files(Picture *picture, Error *error)
{
    const Options *options = picture->options;
    if (!provenance_check_date(error))
        return EXIT_USAGE;
    if ((options->output_path != NULL && !output_file_check(options->output_path, error)) ||
        (options->reference_path != NULL && !output_file_check(options->reference_path, error)))
        return EXIT_OUTPUT;
    if (!options->resume)
        return EXIT_DONE;
    const bool is_exr = image_format_takes_layers(options->format);
    return resume_prepare(&picture->resume, options->output_path, is_exr, error) ? EXIT_DONE
                                                                                 : EXIT_SCENE;
}

// Fails if a picture that is drawn in parts has too many tiles. EXR files number tiles by 31 bits.
// If there is only one part, its framebuffer has all tiles, one below another.
static bool check_tiles(const RenderSettings *settings, Error *error)
{
    RenderSettings whole = *settings;
    whole.part = whole.parts = 0;
    const uint64_t rows = tile_count(&whole) * tile_largest(&whole).height;
    return settings->parts == 0 || rows <= INT32_MAX ||
           error_set(error,
                     "the picture has too many tiles of %u x %u for --part: give larger ones",
                     settings->tile_width, settings->tile_height);
}

// Fails if the picture, or the reference, is too large for the format of its file.
static bool check_sizes(const Options *options, const RenderSettings *settings, Error *error)
{
    const uint32_t width = settings->width, height = settings->height;
    const char *reference = options->reference_path;
    return check_tiles(settings, error) &&
           image_check_size(options->format, width, height, error) &&
           (reference == NULL ||
            image_check_size(image_format_of_path(reference), width, height, error));
}

static ExitCode prepare(Picture *picture, Error *error)
{
    Scene *scene = picture->scene;
    const Options *options = picture->options;
    picture_warn_of_goal(options);
    const ExitCode started = stage_start(picture->session, scene, options, &picture->stages, error);
    if (started != EXIT_DONE)
        return started;
    if (!stage_request(&picture->request, options, scene, error))
        return EXIT_SCENE;
    picture_warn_of_few_tiles(options, &picture->request.settings);
    if (!check_sizes(options, &picture->request.settings, error))
        return EXIT_OUTPUT;
    const double pictures = options->repeat * (double)frames_count(&options->frames);
    const SessionWork work = session_picture_work(&picture->request, pictures);
    const ExitCode prepared =
        stage_prepare(picture->session, options, &work, &picture->stages, error);
    if (prepared != EXIT_DONE)
        return prepared;
    picture->form = session_scene_own_form(picture->session, error);
    if (!session_prepare_picture(picture->session, &picture->request, &picture->drawn, error))
        return EXIT_DEVICE;
    if (options->verbose)
        report_write_setup(picture, stderr);
    return EXIT_DONE;
}

static void clear(Picture *picture)
{
    framebuffer_free(&picture->framebuffer);
    framebuffer_free(&picture->reference.picture);
    layers_free(&picture->layers);
    picture_result_free(&picture->drawn);
    picture->repetition_count = 0;
}

static void set_view(Picture *picture, uint32_t number)
{
    const Options *options = picture->options;
    const Scene *scene = picture->scene;
    const uint32_t steps = options->frames.turntable;
    picture->view = steps > 0 ? options->picture.view : number;
    picture->turned = steps > 0 ? 360.0 * (number - 1) / steps : 0;
    picture->request.viewpoint = camera_turn(&scene->viewpoints.data[picture->view - 1],
                                             scene->has_course_views, picture->turned);
}

static bool make_framebuffer(Framebuffer *framebuffer, uint32_t width, uint32_t height,
                             Error *error)
{
    const unsigned long long bytes = sizeof *framebuffer->pixels * width * (uint64_t)height;
    return framebuffer_make(framebuffer, width, height, &(Error){0}) ||
           error_set(error,
                     "out of memory: the pixels need %llu MB: give a smaller --size, or draw "
                     "parts of an EXR file with --part",
                     bytes / 1000000 + 1);
}

// Creates a black picture. With --resume, copies the finished tiles of an earlier run into the
// picture.
static bool begin_picture(Picture *picture, Error *error)
{
    Provenance own;
    uint32_t width, height;
    Picture finished = *picture;
    RenderSettings *settings = &picture->request.settings;
    finished.complete = true;
    report_fill_provenance(&own, &finished);
    tile_frame_size(settings, &width, &height);
    return make_framebuffer(&picture->framebuffer, width, height, error) &&
           resume_open(&picture->resume, &own, settings, &picture->framebuffer, error);
}

static ExitCode finish(Picture *picture, Error *error)
{
    if (picture->options->frames.skips_finished && !picture->complete) {
        error_set(error, "stopped: %s is not written", picture->path);
        return (ExitCode)(128 + picture->stopped_by);
    }
    if (!write_picture(picture, error) || !picture_error_write_reference(picture, error) ||
        !write_statistics(picture, error))
        return EXIT_OUTPUT;
    resume_close(&picture->resume, picture->complete);
    if (picture->stopped_by > 0)
        return picture_fail_stopped(picture, error);
    if (!report_print_hash(picture->options, picture->pixel_hash, error))
        return EXIT_FAULTS;
    return picture->drawn.facts.goal_missed ? picture_fail_goal(picture, error) : EXIT_DONE;
}

static ExitCode make_frame(Picture *picture, uint32_t number, Error *error)
{
    clear(picture);
    set_view(picture, number);
    if (!session_choose_level(picture->session, &picture->request, error))
        return EXIT_DEVICE;
    if (!begin_picture(picture, error))
        return picture->resume.journal.is_busy     ? EXIT_BUSY
               : picture->resume.journal.is_broken ? EXIT_OUTPUT
                                                   : EXIT_SCENE;
    picture_print_beginning(picture);
    stop_wait_for_tiles();
    if (!draw(picture, error))
        return picture->resume.journal.is_broken ? EXIT_OUTPUT : EXIT_DEVICE;
    if (!certify(picture, error) || !draw_layers(picture, error) ||
        !picture_error_measure(picture, error))
        return EXIT_DEVICE;
    return finish(picture, error);
}

// Draws all frames. If a frame misses its goal, the remaining frames are still drawn.
static ExitCode make_frames(Picture *picture, Error *error)
{
    ExitCode outcome = EXIT_DONE;
    const Frames *frames = &picture->options->frames;
    const uint32_t count = frames_count(frames);
    if (frames->is_film && !open_film(picture, error))
        return EXIT_OUTPUT;
    for (uint32_t place = 0; place < count && outcome <= EXIT_FAULTS; place++) {
        const uint32_t number = frames_at(frames, place);
        if (stop_signal() != 0 && !frames->is_film) {
            error_set(error, "stopped: %u of %u pictures are drawn", place, count);
            return (ExitCode)(128 + stop_signal());
        }
        char *name = frames_name(picture->options->output_path, number, error);
        if (name == NULL)
            return EXIT_OUTPUT;
        picture->path = frames->is_film ? picture->path : name;
        const bool is_finished = frames->skips_finished && access(name, F_OK) == 0;
        const ExitCode code = is_finished ? EXIT_DONE : make_frame(picture, number, error);
        outcome = code > outcome ? code : outcome;
        free(name);
    }
    return outcome;
}

ExitCode picture_make(const Options *options, Session *session, Scene *scene, Error *error)
{
    const double start = clock_seconds();
    Picture picture = {.options = options,
                       .session = session,
                       .scene = scene,
                       .path = options->output_path,
                       .start = start,
                       .moment = start};
    stop_watch();
    ExitCode code = check_files(&picture, error);
    if (code == EXIT_DONE)
        code = prepare(&picture, error);
    if (code == EXIT_DONE)
        code = frames_are_many(&options->frames)
                   ? make_frames(&picture, error)
                   : make_frame(&picture, options->picture.view, error);
    clear(&picture);
    framebuffer_free(&picture.film);
    resume_close(&picture.resume, false);
    return code;
}
