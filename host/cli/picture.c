// SPDX-License-Identifier: MIT
// Renders a scene file to picture files.
#include "cli/commands.h"

#include "base/clock.h"
#include "base/output_file.h"
#include "base/stop.h"
#include "cli/certain_picture.h"
#include "cli/command_files.h"
#include "cli/reference.h"
#include "cli/refined_picture.h"
#include "cli/report_provenance.h"
#include "image/image_file.h"
#include "refine/refine_tree.h"
#include "render/aov_pass.h"
#include "render/tile.h"
#include "scene/camera.h"
#include "scene/turn.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// With a value of --error above this, the user may have meant percent.
#define LARGE_ERROR 0.1

// The context of the render observer.
typedef struct {
    Run *run;
    Progress progress;
    Error *error;
} Watch;

static bool tile_done(void *context, const RenderProgress *render)
{
    Watch *watch = context;
    Run *run = watch->run;
    return resume_keep(&run->resume, &run->settings, &run->framebuffer, render->tiles_done - 1,
                       watch->error) &&
           progress_tile_done(&watch->progress, render);
}

// Draws the picture once and records its time.
static bool draw_frame(Run *run, const CameraData *camera, Error *error)
{
    double moment = clock_seconds();
    Watch watch = {run, progress_begin(run->options->quiet), error};
    const RenderObserver observer = {tile_done, &watch};
    const bool ok =
        options_are_adaptive(run->options)
            ? refined_picture_draw(run, camera, &observer, error)
            : renderer_draw(&run->renderer, camera, &observer, &run->framebuffer, error);
    run->stopped_by = progress_end(&watch.progress);
    const double seconds = run_lap(&moment);
    if (run->options->verbose && ok)
        fprintf(stderr, "traced in %.4f s\n", seconds);
    run->report.frame_seconds[run->report.frame_count++] = seconds;
    return ok && !run->resume.is_broken;
}

static CameraData camera_of(const Run *run, uint32_t samples)
{
    return camera_make(&run->viewpoint, &run->normalization, render_whole_height(&run->settings),
                       samples);
}

// Returns the number of sample positions along a pixel's side.
static uint32_t samples_across(const Run *run)
{
    if (run->options->contrast > 0)
        return REFINE_GRID;
    return options_are_adaptive(run->options) ? LADDER_GRID : run->settings.samples;
}

// Stores the number of pixels, and the number of samples unless refining has already counted them.
static void count_samples(Run *run)
{
    Report *report = &run->report;
    const RenderSettings *settings = &run->settings;
    report->pixels = options_are_adaptive(run->options) ? tile_pixels(settings) : 0;
    if (report->pixels > 0)
        return;
    for (uint64_t number = settings->ready_tiles; number < report->tiles_done; number++) {
        const Tile tile = tile_at(settings, number);
        report->pixels += (uint64_t)tile.width * tile.height;
    }
    report->samples = report->pixels * settings->samples * settings->samples;
}

static bool draw(Run *run, Error *error)
{
    const CameraData camera = camera_of(run, samples_across(run));
    bool ok = true;
    for (uint32_t frame = 0; ok && run->stopped_by == 0 && frame < run->options->repeat; frame++)
        ok = draw_frame(run, &camera, error);
    run->report.trace = run->report.frame_seconds[0];
    const RenderProgress *done = &run->renderer.progress;
    run->report.tiles_done = done->tiles_done;
    run->report.complete = ok && done->tiles_done == done->tiles;
    for (int kind = 0; kind < TALLY_KINDS; kind++)
        run->report.tallies[kind] = done->tallies[kind];
    count_samples(run);
    return ok;
}

static bool trace_layers(Run *run, const AovPass *pass, Error *error)
{
    Progress progress = progress_begin(run->options->quiet);
    const RenderObserver observer = {progress_tile_done, &progress};
    const bool ok = aov_pass_draw(pass, &observer, &run->layers, error);
    run->stopped_by = progress_end(&progress);
    run->report.complete = run->report.complete && run->stopped_by == 0;
    return ok;
}

static bool certify(Run *run, Error *error)
{
    const CameraData camera = camera_of(run, run->settings.samples);
    return !aov_needs(run->options->aovs, AOV_NEEDS_CERTAINTY) ||
           certain_picture_make(run, &camera, error);
}

// Computes the channels besides the colors. If the picture was stopped, all their values are zero.
static bool draw_layers(Run *run, Error *error)
{
    AovPass pass;
    const AovSet aovs = run->options->aovs;
    const RenderSettings *settings = &run->settings;
    const AovSource source = {.setup = &run->async_device.setup,
                              .renderer = &run->renderer,
                              .camera = camera_of(run, settings->samples),
                              .center = camera_of(run, 1),
                              .samples = run->samples,
                              .scene = {&run->normalization, run->flat.light_count},
                              .certainty = run->certainty.marks != NULL ? &run->certainty : NULL};
    aov_name_layers(aovs, &run->layers);
    reference_name_layer(run->options, &run->layers);
    if (!layers_make(&run->layers, settings->width, settings->height, error))
        return false;
    if (aovs == 0 || run->stopped_by != 0)
        return true;
    if (!aov_pass_open(&pass, aovs, &source, error))
        return false;
    const bool ok = trace_layers(run, &pass, error);
    aov_pass_close(&pass);
    return ok;
}

static bool measure_error(Run *run, Error *error)
{
    if (!run->options->reference)
        return true;
    const bool ok = reference_measure(run, error);
    if (ok && !run->options->quiet)
        report_write_error(&run->report, stderr);
    return ok;
}

static bool write_reference(const Run *run, Error *error)
{
    const char *path = run->options->reference_path;
    return path == NULL || run->reference.pixels == NULL || reference_write(run, path, error);
}

static bool write_picture(Run *run, Error *error)
{
    Provenance provenance;
    const Options *options = run->options;
    double moment = clock_seconds();
    framebuffer_hash(&run->framebuffer, run->report.pixel_hash);
    report_fill_provenance(&provenance, &run->report);
    provenance_list(&provenance);
    const ImageSettings settings = {.format = options->format,
                                    .encoding = options->encoding,
                                    .left = run->settings.left,
                                    .top = run->settings.top,
                                    .whole_width = render_whole_width(&run->settings),
                                    .whole_height = render_whole_height(&run->settings),
                                    .texts = provenance.list,
                                    .text_count = options->no_metadata ? 0 : provenance.count,
                                    .layers = run->layers.count > 0 ? &run->layers : NULL};
    const bool ok = image_write(&run->framebuffer, run->output_path, &settings, error);
    run->report.write = run_lap(&moment);
    return ok;
}

static bool write_statistics(Run *run, double start, Error *error)
{
    const Options *options = run->options;
    run->report.total = clock_seconds() - start;
    if (!options->statistics)
        return true;
    if (options->statistics_path == NULL) {
        report_write_text(&run->report, stderr);
        return true;
    }
    return report_write_json(&run->report, options->statistics_path, error);
}

static void describe(const Run *run)
{
    const Report *report = &run->report;
    if (!run->options->verbose)
        return;
    fprintf(stderr, "scene: %u triangles, %u spheres, %u lights; %llu triangles dropped\n",
            report->triangles, report->spheres, report->lights,
            (unsigned long long)report->dropped_triangles);
    fprintf(stderr, "tree: %u nodes, %u leaves of at most %u triangles, %u levels\n",
            report->bvh_nodes, report->bvh_leaves, report->bvh_largest_leaf, report->bvh_depth);
    const Device *device = &run->async_device.device;
    fprintf(stderr, "device: %s, driver %s, %u compute units\n", device->name, device->version,
            device->compute_units);
    fprintf(stderr, "kernels: %s, %s nodes, %s, %s, ready in %.3f s; uploaded %zu bytes\n",
            kernel_family_name(report->choice->family), kernel_nodes_name(report->choice->nodes),
            kernel_precision_name(report->choice->precision),
            report->specialized ? "specialized" : "general", report->kernel_build,
            report->upload_size);
}

static void print_beginning(const Run *run)
{
    if (!run->options->verbose)
        return;
    if (frames_are_many(&run->options->frames))
        fprintf(stderr, "picture: %s\n", run->output_path);
    if (run->options->resume)
        fprintf(stderr, "resumed: %llu of %llu tiles are there\n",
                (unsigned long long)run->settings.ready_tiles,
                (unsigned long long)tile_count(&run->settings));
}

static ExitCode goal_missed(const Run *run, Error *error)
{
    const Report *report = &run->report;
    if (run->options->time_goal > 0)
        error_set(error, "one sample a pixel took %.3f s, longer than --time allows",
                  report->trace);
    else
        error_set(error, "the error may be %.2g %%, more than --error allows",
                  100 * fmax(report->bound, report->truncation));
    return EXIT_FAULTS;
}

// Reports invalid dates and unwritable outputs before any work, and looks for an earlier run.
static ExitCode check_files(Run *run, Error *error)
{
    const Options *options = run->options;
    if (!provenance_check_date(error))
        return EXIT_USAGE;
    if (!output_file_check(options->output_path, error) ||
        (options->reference_path != NULL && !output_file_check(options->reference_path, error)))
        return EXIT_OUTPUT;
    return options->resume && !resume_look(&run->resume, options, error) ? EXIT_SCENE : EXIT_DONE;
}

static void warn_of_goal(const Options *options)
{
    if (options->error_goal > LARGE_ERROR && !options->quiet)
        fprintf(stderr, "clrt: --error allows an error of %g %%; for %g %%, write %g%%\n",
                100 * options->error_goal, options->error_goal, options->error_goal);
}

static ExitCode prepare(Run *run, Error *error)
{
    warn_of_goal(run->options);
    image_prepare(run->options->format);
    run_begin(run);
    if (!run_load_scene(run, error))
        return EXIT_SCENE;
    if (!command_files_check(run->options, &run->scene, error) ||
        !image_check_size(run->options->format, run->settings.width, run->settings.height, error))
        return EXIT_OUTPUT;
    const ExitCode prepared = run_prepare(run, error);
    if (prepared == EXIT_DONE)
        describe(run);
    return prepared;
}

// Frees the previous frame's picture.
static void clear(Run *run)
{
    framebuffer_free(&run->framebuffer);
    framebuffer_free(&run->reference);
    layers_free(&run->layers);
    certainty_map_free(&run->certainty);
    free(run->samples);
    run->samples = NULL;
    run->report.frame_count = 0;
}

// Sets the viewpoint of frame `number`.
static void look(Run *run, uint32_t number)
{
    const Options *options = run->options;
    const uint32_t steps = options->frames.turntable;
    run->report.view = steps > 0 ? options->view : number;
    run->report.turned = steps > 0 ? 360.0 * (number - 1) / steps : 0;
    run->viewpoint = turn_viewpoint(&run->scene.viewpoints.data[run->report.view - 1],
                                    run->scene.has_course_views, run->report.turned);
}

// Creates a black picture and copies the finished tiles of an earlier run into it.
static bool begin_picture(Run *run, Error *error)
{
    Provenance own;
    RenderSettings *settings = &run->settings;
    report_fill_provenance(&own, &run->report);
    const bool ok = framebuffer_make(&run->framebuffer, settings->width, settings->height, error) &&
                    resume_open(&run->resume, &own, settings, &run->framebuffer, error);
    run->renderer.settings.ready_tiles = settings->ready_tiles;
    return ok;
}

static ExitCode report_stopped(const Run *run, Error *error)
{
    const RenderProgress *progress = &run->renderer.progress;
    const char *path = run->output_path, *name = strcmp(path, "-") == 0 ? "the picture" : path;
    if (run->report.complete)
        error_set(error, "stopped: %s is whole", name);
    else if (progress->tiles_done == progress->tiles || options_are_adaptive(run->options))
        error_set(error, "stopped: %s is incomplete", name);
    else
        error_set(error, "stopped: %s is incomplete, with %llu of %llu tiles", name,
                  (unsigned long long)progress->tiles_done, (unsigned long long)progress->tiles);
    return (ExitCode)(128 + run->stopped_by);
}

static ExitCode finish(Run *run, double start, Error *error)
{
    if (!write_picture(run, error) || !write_reference(run, error) ||
        !write_statistics(run, start, error))
        return EXIT_OUTPUT;
    resume_close(&run->resume, run->report.complete);
    if (run->stopped_by > 0)
        return report_stopped(run, error);
    if (!report_print_hash(run->options, run->report.pixel_hash, error))
        return EXIT_FAULTS;
    return run->report.goal_missed ? goal_missed(run, error) : EXIT_DONE;
}

static ExitCode make_frame(Run *run, uint32_t number, double start, Error *error)
{
    clear(run);
    look(run, number);
    if (!begin_picture(run, error))
        return run->resume.is_broken ? EXIT_OUTPUT : EXIT_SCENE;
    print_beginning(run);
    stop_wait_for_tiles();
    if (!draw(run, error))
        return run->resume.is_broken ? EXIT_OUTPUT : EXIT_DEVICE;
    if (!certify(run, error) || !draw_layers(run, error) || !measure_error(run, error))
        return EXIT_DEVICE;
    return finish(run, start, error);
}

// Draws all frames. If a frame misses its goal, the remaining frames are still drawn.
static ExitCode make_frames(Run *run, double start, Error *error)
{
    ExitCode outcome = EXIT_DONE;
    const Frames *frames = &run->options->frames;
    const uint32_t count = frames_count(frames);
    for (uint32_t place = 0; place < count && outcome <= EXIT_FAULTS; place++) {
        const uint32_t number = frames_at(frames, place);
        if (stop_signal() != 0) {
            error_set(error, "stopped: %u of %u pictures are drawn", place, count);
            return (ExitCode)(128 + stop_signal());
        }
        char *name = frames_name(run->options->output_path, number, error);
        if (name == NULL)
            return EXIT_OUTPUT;
        run->output_path = name;
        const ExitCode code = make_frame(run, number, start, error);
        outcome = code > outcome ? code : outcome;
        free(name);
    }
    return outcome;
}

ExitCode picture_make(Run *run, Error *error)
{
    const Options *options = run->options;
    const double start = clock_seconds();
    stop_watch();
    ExitCode code = check_files(run, error);
    if (code == EXIT_DONE)
        code = prepare(run, error);
    if (code != EXIT_DONE)
        return code;
    if (frames_are_many(&options->frames))
        return make_frames(run, start, error);
    run->output_path = options->output_path;
    return make_frame(run, options->view, start, error);
}
