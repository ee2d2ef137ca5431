// SPDX-License-Identifier: MIT
// The program: runs the pipeline from a scene file to a picture file, and words what went wrong.
// Every stage borrows the ones before it and fills a value of its own; a zeroed value is valid and
// freeing it does nothing, so there is one way out.
#include "accel/flat.h"
#include "base/clock.h"
#include "cli/check.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/show.h"
#include "cli/starter.h"
#include "cli/threads.h"
#include "image/image_file.h"
#include "render/renderer.h"
#include "scene/camera.h"
#include "scene/scn.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

// With so many, a tree takes longer to build than a compiled kernel to be loaded.
#define MANY_TRIANGLES 20000

typedef struct {
    const Options *options;
    Cache cache;
    Scene scene;
    Normalization normalization;
    FlatScene flat;
    Starter starter;
    RenderSettings settings;
    Renderer renderer;
    Framebuffer framebuffer;
    Report report;
    int stopped_by; // a signal, 0 where the picture is whole
} Run;

// Returns the seconds since *moment, and moves it to now.
static double lap(double *moment)
{
    const double before = *moment;
    *moment = clock_seconds();
    return *moment - before;
}

static RenderSettings settings_of(const Options *options, const Scene *scene)
{
    const bool sized = options->width > 0;
    return (RenderSettings){
        .width = sized ? options->width : scene->width,
        .height = sized ? options->height : scene->height,
        .samples = options->samples,
        .max_level = options->max_level >= 0 ? (uint32_t)options->max_level : scene->max_level,
        .tile_width = options->tile_width,
        .tile_height = options->tile_height,
        .group_width = options->group_width,
        .group_height = options->group_height,
        .statistics = options->statistics,
        .specialization = options->specialization,
    };
}

static bool load_scene(Run *run, Error *error)
{
    double moment = clock_seconds();
    const Options *options = run->options;
    bool ok = scn_load(&run->scene, options->scene_path, error);
    if (ok && options->view > run->scene.viewpoints.count)
        ok = error_set(error, "%s has %zu viewpoints, so there is no view %u", options->scene_path,
                       run->scene.viewpoints.count, options->view);
    run->report.load = run->scene.mesh_seconds;
    run->report.parse = lap(&moment) - run->report.load;
    ok = ok && check_geometry(options, &run->scene, error);
    run->normalization = normalization_of(&run->scene);
    Error cause = {0};
    if (ok && !normalization_check(&run->normalization, &run->scene, &cause))
        ok = error_set(error, "%s: %s", options->scene_path, cause.text);
    run->report.build = lap(&moment);
    run->settings = settings_of(options, &run->scene);
    return ok;
}

// The device and the scene decide about the kernels, and they about the layout.
static bool await_device(Run *run, Error *error)
{
    Starter *starter = &run->starter;
    const uint64_t triangles = scene_triangle_count(&run->scene);
    if (triangles < MANY_TRIANGLES)
        starter_decide(starter, false);
    if (!starter_wait_device(starter, error))
        return false;
    starter_choose(starter, &run->settings, triangles);
    starter_decide(starter, true);
    run->report.device = starter->device_seconds;
    run->report.device_name = starter->device.name;
    run->report.device_version = starter->device.version;
    run->report.choice = &starter->setup.source.choice;
    run->settings.group_width = starter->group[0];
    run->settings.group_height = starter->group[1];
    return true;
}

// Scene to arrays.
static bool build_scene(Run *run, Error *error)
{
    Triangles triangles = {0};
    Bvh bvh = {0};
    double moment = clock_seconds();
    const Options *options = run->options;
    const NodeLayout layout = run->starter.setup.source.choice.nodes;
    Crew *crew = crew_open(threads_allowed(options->threads));
    const BvhSettings settings = {options->builder, flat_leaves(layout)};
    const FlatSource source = {&run->scene, &triangles, &bvh, &run->normalization, layout, crew};
    const bool ok = triangles_make(&triangles, &run->scene, &run->normalization, crew, error) &&
                    (!options->uses_bvh || bvh_build(&bvh, &triangles, &settings, crew, error)) &&
                    flat_make(&run->flat, &source, error);
    crew_close(crew);
    run->report.build += lap(&moment);
    if (ok)
        report_count_scene(&run->report, &run->scene, &bvh);
    bvh_free(&bvh);
    triangles_free(&triangles);
    return ok;
}

static bool open_renderer(Run *run, Error *error)
{
    Starter *starter = &run->starter;
    starter_wait_kernel(starter);
    if (!renderer_open(&run->renderer, &starter->setup, &run->flat, &run->settings, error))
        return false;
    run->report.upload = run->renderer.upload_seconds;
    run->report.upload_size = run->renderer.upload_size;
    run->report.kernel_build = run->renderer.build_seconds;
    run->report.specialized = run->renderer.is_special;
    return true;
}

// One picture of as many as were asked for; they are the same.
static bool draw_frame(Run *run, const CameraData *camera, Error *error)
{
    double moment = clock_seconds();
    Progress progress = progress_begin(run->options->quiet);
    const RenderObserver observer = {progress_tile_done, &progress};
    const bool ok = renderer_draw(&run->renderer, camera, &observer, &run->framebuffer, error);
    run->stopped_by = progress_end(&progress);
    const double seconds = lap(&moment);
    if (run->options->verbose && ok)
        fprintf(stderr, "traced in %.4f s\n", seconds);
    run->report.frame_seconds[run->report.frame_count++] = seconds;
    return ok;
}

static bool draw(Run *run, Error *error)
{
    const RenderSettings *settings = &run->settings;
    const Viewpoint *viewpoint = &run->scene.viewpoints.data[run->options->view - 1];
    const CameraData camera =
        camera_make(viewpoint, &run->normalization, settings->height, settings->samples);
    if (!framebuffer_make(&run->framebuffer, settings->width, settings->height, error))
        return false;
    bool ok = true;
    double moment = clock_seconds();
    for (uint32_t frame = 0; ok && run->stopped_by == 0 && frame < run->options->frames; frame++)
        ok = draw_frame(run, &camera, error);
    starter_note_traced(&run->starter, lap(&moment));
    run->report.trace = run->report.frame_seconds[0];
    const RenderProgress *done = &run->renderer.progress;
    run->report.complete = ok && done->tiles_done == done->tiles;
    for (int kind = 0; kind < TALLY_KINDS; kind++)
        run->report.tallies[kind] = done->tallies[kind];
    return ok;
}

static bool write_picture(Run *run, Error *error)
{
    ReportTexts texts;
    const Options *options = run->options;
    double moment = clock_seconds();
    report_make_texts(&run->report, &texts);
    const ImageSettings settings = {.format = options->format,
                                    .encoding = options->encoding,
                                    .texts = texts.texts,
                                    .text_count = REPORT_TEXTS};
    const bool ok = image_write(&run->framebuffer, options->output_path, &settings, error);
    run->report.write = lap(&moment);
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
    framebuffer_hash(&run->framebuffer, run->report.pixel_hash);
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
    const Device *device = &run->starter.device;
    fprintf(stderr, "device: %s, driver %s, %u compute units\n", device->name, device->version,
            device->compute_units);
    fprintf(stderr, "kernels: %s, %s nodes, %s, %s, ready in %.3f s; uploaded %zu bytes\n",
            kernel_family_name(report->choice->family), kernel_nodes_name(report->choice->nodes),
            kernel_precision_name(report->choice->precision),
            report->specialized ? "specialized" : "general", report->kernel_build,
            report->upload_size);
}

static void begin_start(Run *run)
{
    const RendererSetup setup = {.cache = &run->cache,
                                 .source = {.kernel_folder = getenv("CLRT_KERNEL_DIR")}};
    starter_begin(&run->starter, run->options, setup);
}

static ExitCode render(Run *run, Error *error)
{
    const double start = clock_seconds();
    if (!image_check_path(run->options->output_path, error))
        return EXIT_OUTPUT;
    image_prepare(run->options->format);
    begin_start(run);
    if (!load_scene(run, error)) {
        starter_decide(&run->starter, false);
        return EXIT_SCENE;
    }
    if (!image_check_size(run->options->format, run->settings.width, run->settings.height, error))
        return EXIT_OUTPUT;
    if (!await_device(run, error))
        return EXIT_DEVICE;
    if (!build_scene(run, error))
        return EXIT_SCENE;
    if (!open_renderer(run, error))
        return EXIT_DEVICE;
    describe(run);
    if (!draw(run, error))
        return EXIT_DEVICE;
    if (!write_picture(run, error) || !write_statistics(run, start, error))
        return EXIT_OUTPUT;
    return run->stopped_by > 0 ? (ExitCode)(128 + run->stopped_by) : EXIT_DONE;
}

// Makes the kernel once, which leaves it in the cache, and tells of it.
static bool warm_kernel(Run *run, const SceneTraits *traits, const char *name, Error *error)
{
    ReadyKernel ready;
    const Starter *starter = &run->starter;
    const KernelChoice *choice = &starter->setup.source.choice;
    if (!ready_kernel_make(&ready, &starter->setup, traits, starter->group, error))
        return false;
    if (!run->options->quiet)
        printf("%s kernels, %s, %s nodes, %s: %s %.2f s\n", name,
               kernel_family_name(choice->family), kernel_nodes_name(choice->nodes),
               kernel_precision_name(choice->precision),
               ready.was_compiled ? "were compiled, ready in" : "compiled in", ready.seconds);
    ready_kernel_free(&ready);
    return true;
}

static ExitCode warm(Run *run, Error *error)
{
    const Options *options = run->options;
    const bool has_scene = options->scene_path != NULL;
    begin_start(run);
    starter_decide(&run->starter, false);
    if (has_scene && !load_scene(run, error))
        return EXIT_SCENE;
    if (!await_device(run, error))
        return EXIT_DEVICE;
    if (has_scene && !build_scene(run, error))
        return EXIT_SCENE;
    starter_wait_kernel(&run->starter);
    const SceneTraits general = traits_general(options->statistics);
    if ((!has_scene || options->specialization != SPECIALIZE_ALWAYS) &&
        !warm_kernel(run, &general, "general", error))
        return EXIT_DEVICE;
    if (!has_scene || options->specialization == SPECIALIZE_NEVER)
        return EXIT_DONE;
    const SceneTraits special = traits_of(&run->flat, options->statistics);
    return warm_kernel(run, &special, "special", error) ? EXIT_DONE : EXIT_DEVICE;
}

static ExitCode show(Run *run, Error *error)
{
    return show_scene(run->options, &run->cache, error);
}

static ExitCode check(Run *run, Error *error)
{
    return check_scene(run->options, &run->cache, error);
}

static ExitCode perform_run(const Options *options, ExitCode perform_stages(Run *, Error *),
                            Error *error)
{
    Run run = {.options = options};
    run.report.options = options;
    run.report.settings = &run.settings;
    cache_open(&run.cache);
    threads_limit(options->threads);
    const ExitCode code = perform_stages(&run, error);
    framebuffer_free(&run.framebuffer);
    starter_wait_kernel(&run.starter);
    if (CLRT_TIDY_EXIT) {
        renderer_close(&run.renderer);
        starter_free(&run.starter);
    }
    flat_free(&run.flat);
    scene_free(&run.scene);
    cache_close(&run.cache);
    return code;
}

static ExitCode list_devices(Error *error)
{
    char list[8192];
    Cache cache;
    cache_open(&cache);
    const bool ok = device_list(list, sizeof list, error);
    cache_close(&cache);
    if (ok)
        fputs(list, stdout);
    return ok ? EXIT_DONE : EXIT_DEVICE;
}

static ExitCode perform(int count, char **words, Error *error)
{
    Options options;
    if (!options_parse(&options, count, words, error))
        return EXIT_USAGE;
    switch (options.action) {
    case ACTION_HELP:
        options_write_help(stdout);
        return EXIT_DONE;
    case ACTION_VERSION:
        puts("clrt " CLRT_VERSION);
        return EXIT_DONE;
    case ACTION_LIST_DEVICES:
        return list_devices(error);
    case ACTION_WARM:
        return perform_run(&options, warm, error);
    case ACTION_VIEW:
        return perform_run(&options, show, error);
    case ACTION_CHECK:
        return perform_run(&options, check, error);
    case ACTION_RENDER:
        break;
    }
    return perform_run(&options, render, error);
}

int main(int count, char **words)
{
    Error error = {0};
    // A reader that leaves early is a failed write, to be told and cleaned up after.
    signal(SIGPIPE, SIG_IGN);
    ExitCode code = perform(count, words, &error);
    if (code <= EXIT_FAULTS && (fflush(stdout) != 0 || ferror(stdout))) {
        error_set(&error, "standard output cannot be written");
        code = EXIT_OUTPUT;
    }
    if (error.text[0] != '\0')
        fprintf(stderr, "clrt: %s\n", error.text);
    // The system takes down in no time what drivers and libraries take 0.1 s to.
    if (!CLRT_TIDY_EXIT)
        _exit((int)code);
    return (int)code;
}
