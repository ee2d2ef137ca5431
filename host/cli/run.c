// SPDX-License-Identifier: MIT
// The stages from a scene file to an open renderer.
#include "cli/run.h"

#include "accel/flat.h"
#include "base/clock.h"
#include "cli/commands.h"
#include "cli/options/option.h"
#include "cli/process.h"
#include "device/device.h"
#include "image/image_file.h"
#include "scene/scene.h"
#include "scene/scn.h"

#include <math.h>
#include <string.h>

// The truncation of reflections may use this fraction of the error goal. The fraction is small
// because more levels cost less than more samples.
#define TRUNCATION_PART 0.25

// The samples per pixel and axis of a lone mesh.
#define MESH_SAMPLES 3

// Up to this number, testing all triangles is faster than traversing a tree. With 8, 16, 32 and 64
// triangles, packets take 0.92, 0.91, 0.95 and 1.06 times as long without a tree as with one.
#define FEW_TRIANGLES 32

double run_lap(double *moment)
{
    const double before = *moment;
    *moment = clock_seconds();
    return *moment - before;
}

static uint32_t max_level_of(const Options *options, const Scene *scene)
{
    const char *format = options->format != NULL ? options->format : "png";
    if (options->fits_level)
        return truncation_level(scene, image_format_half_step(format, options->encoding) /
                                           exp2(options->exposure));
    if (options->max_level < 0 && options->error_goal > 0)
        return truncation_level(scene, options->error_goal * TRUNCATION_PART);
    return options->max_level >= 0 ? (uint32_t)options->max_level : scene->max_level;
}

// A lone mesh is anti-aliased unless the options choose its samples.
static uint32_t samples_of(const Options *options, const Scene *scene)
{
    const bool is_chosen = option_is_given(options, "aa") || options_are_adaptive(options);
    return is_chosen || scene->mesh_up == UP_AUTO ? options->samples : MESH_SAMPLES;
}

static RenderSettings settings_of(const Options *options, const Scene *scene)
{
    const bool sized = options->width > 0;
    const bool small = options->parts > 0 && !option_is_given(options, "tile");
    return (RenderSettings){
        .width = sized ? options->width : scene->width,
        .height = sized ? options->height : scene->height,
        .samples = samples_of(options, scene),
        .max_level = max_level_of(options, scene),
        .tile_width = small ? OPTIONS_PART_TILE : options->tile_width,
        .tile_height = small ? OPTIONS_PART_TILE : options->tile_height,
        .part = options->parts > 0 ? options->part - 1 : 0,
        .parts = options->parts,
        .group_width = options->group_width,
        .group_height = options->group_height,
        .statistics = options->statistics,
        .specialization = options->specialization,
    };
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
    const uint32_t view = are_views ? frames->last : options->view;
    if (ok && view > run->scene.viewpoints.count)
        ok = error_set(error, "%s has %zu viewpoints, so there is no view %u", options->scene_path,
                       run->scene.viewpoints.count, view);
    run->report.load = run->scene.mesh_seconds;
    run->report.parse = run_lap(&moment) - run->report.load;
    ok = ok && check_geometry(options, &run->scene, error) &&
         check_missing(options, &run->scene, error);
    run->normalization = normalization_of(&run->scene);
    Error cause = {0};
    if (ok && !normalization_check(&run->normalization, &run->scene, &cause))
        ok = error_set(error, "%s: %s", options->scene_path, cause.text);
    run->report.build = run_lap(&moment);
    run->settings = settings_of(options, &run->scene);
    ok = ok && crop_apply(&options->crop, &run->settings, error);
    run->report.truncation = truncation_bound(&run->scene, run->settings.max_level);
    return ok;
}

// Returns whether a tree saves time. With --bvh, few triangles get a tree too.
static bool wants_tree(const Options *options, NodeLayout layout, uint64_t triangles)
{
    const bool are_few = layout == NODES_WIDE && triangles <= FEW_TRIANGLES;
    return option_is_given(options, "bvh") || !are_few;
}

static void count_tree(Report *report, const Bvh *bvh)
{
    report->bvh_nodes = bvh->node_count;
    report->bvh_leaves = bvh->leaf_count;
    report->bvh_depth = bvh->depth;
    report->bvh_largest_leaf = bvh->largest_leaf;
    memcpy(report->bvh_inner, bvh->inner_counts, sizeof report->bvh_inner);
}

static bool compile(const Run *run, FlatScene *flat, CompileStages *stages,
                    const CompileSource *form, Error *error)
{
    const Options *options = run->options;
    CompileSource source = *form;
    source.scene = &run->scene;
    source.normalization = &run->normalization;
    source.builder = options->builder;
    source.has_tree =
        form->has_tree && wants_tree(options, form->layout, scene_triangle_count(&run->scene));
    source.pool = thread_pool_open(threads_allowed(options->threads));
    const bool ok = scene_compile(flat, stages, &source, error);
    thread_pool_close(source.pool);
    return ok;
}

static void show_loading(const Options *options, bool begins)
{
    if (progress_on_terminal() && !options->quiet)
        progress_show_loading(begins);
}

bool run_build_scene(Run *run, Error *error)
{
    CompileStages stages;
    double moment = clock_seconds();
    const CompileSource form = {.layout = run->async_device.setup.source.choice.nodes,
                                .has_tree = !run->options->no_bvh};
    show_loading(run->options, true);
    const bool ok = compile(run, &run->flat, &stages, &form, error);
    show_loading(run->options, false);
    run->report.build += run_lap(&moment);
    if (ok)
        count_tree(&run->report, &stages.bvh);
    compile_stages_free(&stages);
    return ok;
}

const FlatScene *run_compiled_scene(Run *run, NodeLayout layout, Error *error)
{
    FlatScene *other = &run->others[layout];
    const CompileSource form = {.layout = layout, .has_tree = true};
    if (layout == run->flat.layout && !run->options->no_bvh)
        return &run->flat;
    const bool is_compiled = other->lights != NULL;
    return is_compiled || compile(run, other, NULL, &form, error) ? other : NULL;
}

ExitCode run_start(Run *run, Error *error)
{
    run_begin(run);
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
    return renderer_open(&run->renderer, &run->async_device.setup, &run->flat, &run->settings,
                         error)
               ? EXIT_DONE
               : EXIT_DEVICE;
}

void run_free(Run *run)
{
    if (CLRT_TIDY_EXIT)
        renderer_close(&run->renderer);
    program_free(&run->renderer.program);
    run_close_device(run);
    flat_free(&run->flat);
    for (int layout = 0; layout < NODE_LAYOUTS; layout++)
        flat_free(&run->others[layout]);
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
