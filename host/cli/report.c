// SPDX-License-Identifier: MIT
// Writes the report as text, and as JSON with Jansson.
#include "cli/picture.h"

#include "image/json_file.h"

#include <inttypes.h>
#include <sys/resource.h>

#define SCHEMA_VERSION 1

static uint64_t ray_count(const Run *run)
{
    const uint64_t *tallies = run->report.drawn.progress.tallies;
    return tallies[TALLY_CAMERA_RAYS] + tallies[TALLY_SHADOW_RAYS] + tallies[TALLY_REFLECTED_RAYS];
}

static double per_ray(const Run *run, TallyKind kind)
{
    const uint64_t rays = ray_count(run);
    return rays == 0 ? 0 : (double)run->report.drawn.progress.tallies[kind] / (double)rays;
}

static double samples_per_pixel(const Run *run)
{
    const Report *report = &run->report;
    return report->drawn.pixels == 0 ? 0
                                     : (double)report->drawn.samples / (double)report->drawn.pixels;
}

const char *report_tree_name(const Run *run)
{
    if (run->report.tree.node_count == 0)
        return "none";
    return run->options->builder == BVH_MIDPOINT ? "midpoint" : "sah";
}

static void write_error(const Run *run, FILE *stream)
{
    const double truncation = run_counted_truncation(run);
    fprintf(stream, "error: about %.2g %%, at most %.2g %% with 95 %% confidence",
            100 * run->report.drawn.estimate, 100 * run->report.drawn.bound);
    if (truncation > 0)
        fprintf(stream, ", including at most %.2g %% because rays end at level %u",
                100 * truncation, run->settings.max_level);
    fprintf(stream, "\n");
}

void report_write_text(const Run *run, FILE *stream)
{
    const uint64_t *tallies = run->report.drawn.progress.tallies;
    const Report *report = &run->report;
    if (run->options->resume)
        fprintf(stream,
                "%" PRIu64 " of %" PRIu64
                " tiles were finished before: time and counts cover the others\n",
                run->settings.ready_tiles, tile_count(&run->settings));
    fprintf(stream, "%.3f seconds\n", report->frame_seconds[0]);
    fprintf(stream, "%" PRIu64 " samples, %.2f per pixel\n", report->drawn.samples,
            samples_per_pixel(run));
    if (report->drawn.estimate > 0)
        write_error(run, stream);
    fprintf(stream,
            "%" PRIu64 " rays: %" PRIu64 " camera, %" PRIu64 " shadow, %" PRIu64 " reflected\n",
            ray_count(run), tallies[TALLY_CAMERA_RAYS], tallies[TALLY_SHADOW_RAYS],
            tallies[TALLY_REFLECTED_RAYS]);
    fprintf(stream, "%" PRIu64 " triangle tests, %.2f per ray\n", tallies[TALLY_TRIANGLE_TESTS],
            per_ray(run, TALLY_TRIANGLE_TESTS));
    fprintf(stream, "%" PRIu64 " box tests, %.2f per ray\n", tallies[TALLY_BOX_TESTS],
            per_ray(run, TALLY_BOX_TESTS));
    const uint64_t *pixels = report->certainty.pixels;
    if (aov_needs(run->options->aovs, AOV_NEEDS_CERTAINTY))
        fprintf(stream,
                "%" PRIu64 " pixels certified, %" PRIu64 " repaired, %" PRIu64 " open, %.3f s\n",
                pixels[CERTAINTY_CERTIFIED], pixels[CERTAINTY_REPAIRED], pixels[CERTAINTY_OPEN],
                report->certainty.seconds);
}

void report_write_error(const Run *run, FILE *stream)
{
    const ReferenceResult *result = &run->report.reference;
    const Difference *difference = &result->difference;
    const double pixels = (double)difference->pixels;
    if (result->samples == 0)
        return;
    fprintf(
        stream,
        "RMSE %.4g (%.3g %%), largest difference %.4g at %u,%u; off by more than 1/255: %.4g %% "
        "of the pixels, 4/255: %.4g %%\n",
        difference->rmse, 100 * difference->rmse, difference->maximum, difference->maximum_x,
        difference->maximum_y, 100 * (double)difference->off_by_1 / pixels,
        100 * (double)difference->off_by_4 / pixels);
    fprintf(stream, "reference: for fp64, %u samples a pixel, RMSE of the reference %.2g, %.2f s\n",
            result->samples, result->own_error, result->seconds);
}

static json_t *rays_json(const Run *run)
{
    const uint64_t *tallies = run->report.drawn.progress.tallies;
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "camera",
                     json_count(tallies[TALLY_CAMERA_RAYS]), "camera_hits",
                     json_count(tallies[TALLY_CAMERA_HITS]), "shadow",
                     json_count(tallies[TALLY_SHADOW_RAYS]), "reflected",
                     json_count(tallies[TALLY_REFLECTED_RAYS]), "total", json_count(ray_count(run)),
                     "shaded_points", json_count(tallies[TALLY_SHADED_POINTS]));
}

static json_t *tests_json(const Run *run)
{
    const uint64_t *tallies = run->report.drawn.progress.tallies;
    return json_pack(
        "{s:o, s:o, s:o, s:f, s:f, s:f}", "triangle", json_count(tallies[TALLY_TRIANGLE_TESTS]),
        "box", json_count(tallies[TALLY_BOX_TESTS]), "sphere",
        json_count(tallies[TALLY_SPHERE_TESTS]), "triangle_per_ray",
        per_ray(run, TALLY_TRIANGLE_TESTS), "box_per_ray", per_ray(run, TALLY_BOX_TESTS),
        "sphere_per_ray", per_ray(run, TALLY_SPHERE_TESTS));
}

static json_t *seconds_json(const Run *run)
{
    const Report *report = &run->report;
    return json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "parse", report->parse,
                     "load", report->load, "build", report->build, "device",
                     run->session.device_seconds, "upload", run->report.drawn.upload_seconds,
                     "kernel_build", run->report.drawn.build_seconds, "trace",
                     report->frame_seconds[0], "write", report->write, "total", report->total);
}

static json_t *frames_json(const Run *run)
{
    const Report *report = &run->report;
    json_t *list = json_array();
    for (uint32_t frame = 0; frame < report->frame_count; frame++)
        json_array_append_new(list, json_real(report->frame_seconds[frame]));
    return list;
}

static json_t *scene_json(const Run *run)
{
    char hash[SCENE_HASH_SIZE], mesh_hash[SCENE_HASH_SIZE];
    scene_hash_name(run->scene.hash, hash);
    scene_hash_name(run->scene.mesh_hash, mesh_hash);
    return json_pack("{s:o, s:s, s:s, s:o, s:o, s:o, s:o}", "path",
                     json_file_path(run->options->scene_path), "hash", hash, "mesh_hash", mesh_hash,
                     "lights", json_count(run->scene.lights.count), "spheres",
                     json_count(run->scene.spheres.count), "triangles",
                     json_count(scene_triangle_count(&run->scene)), "dropped_triangles",
                     json_count(scene_dropped_count(&run->scene)));
}

static json_t *inner_nodes_json(const Run *run)
{
    const Report *report = &run->report;
    json_t *list = json_array();
    for (uint32_t depth = 0; depth + 1 < report->tree.depth; depth++)
        json_array_append_new(list, json_count(report->tree.inner_counts[depth]));
    return list;
}

static json_t *tree_json(const Run *run)
{
    const Report *report = &run->report;
    return json_pack("{s:s, s:o, s:o, s:o, s:o, s:o}", "builder", report_tree_name(run), "nodes",
                     json_count(report->tree.node_count), "leaves",
                     json_count(report->tree.leaf_count), "depth", json_count(report->tree.depth),
                     "inner_nodes", inner_nodes_json(run), "largest_leaf",
                     json_count(report->tree.largest_leaf));
}

static json_t *settings_json(const Run *run)
{
    const Report *report = &run->report;
    const RenderSettings *settings = &run->settings;
    return json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:f, s:[oo], s:[oo], s:b, s:s, s:s, s:o, s:s}", "view",
        json_count(report->view), "width", json_count(render_whole_width(settings)), "height",
        json_count(render_whole_height(settings)), "crop", crop_json(settings), "samples",
        json_count(settings->samples), "max_level", json_count(settings->max_level),
        "truncation_bound", report->truncation, "tile", json_count(settings->tile_width),
        json_count(settings->tile_height), "work_group", json_count(report->drawn.group[0]),
        json_count(report->drawn.group[1]), "specialized", run->report.drawn.is_special, "kernel",
        kernel_family_name(run->session.choice.family), "nodes",
        kernel_nodes_name(run->session.choice.nodes), "lanes",
        json_count(run->session.choice.lanes), "precision",
        kernel_precision_name(run->session.choice.precision));
}

static json_t *samples_json(const Run *run)
{
    const Report *report = &run->report;
    return json_pack("{s:o, s:f, s:f, s:f, s:f, s:b}", "total", json_count(report->drawn.samples),
                     "per_pixel", samples_per_pixel(run), "contrast", run->options->contrast,
                     "error_estimate", report->drawn.estimate, "error_bound", report->drawn.bound,
                     "goal_reached", !report->drawn.goal_missed);
}

// Returns null for refined pictures, which are drawn in several passes without tiles.
static json_t *tiles_json(const Run *run)
{
    const uint64_t found = run->settings.ready_tiles;
    if (options_are_adaptive(run->options))
        return json_null();
    return json_pack("{s:o, s:o, s:o}", "total", json_count(tile_count(&run->settings)), "found",
                     json_count(found), "drawn",
                     json_count(run->report.drawn.progress.tiles_done - found));
}

static json_t *reference_json(const Run *run)
{
    const ReferenceResult *result = &run->report.reference;
    const Difference *difference = &result->difference;
    const double pixels = (double)difference->pixels;
    if (result->samples == 0)
        return json_null();
    return json_pack("{s:o, s:f, s:f, s:f, s:f, s:f, s:f}", "samples", json_count(result->samples),
                     "rmse", difference->rmse, "own_error", result->own_error, "maximum",
                     difference->maximum, "share_off_by_1", (double)difference->off_by_1 / pixels,
                     "share_off_by_4", (double)difference->off_by_4 / pixels, "seconds",
                     result->seconds);
}

static json_t *certainty_json(const Run *run)
{
    const Report *report = &run->report;
    const uint64_t *pixels = report->certainty.pixels;
    if (!aov_needs(run->options->aovs, AOV_NEEDS_CERTAINTY))
        return json_null();
    return json_pack("{s:o, s:o, s:o, s:f}", "certified", json_count(pixels[CERTAINTY_CERTIFIED]),
                     "repaired", json_count(pixels[CERTAINTY_REPAIRED]), "open",
                     json_count(pixels[CERTAINTY_OPEN]), "seconds", report->certainty.seconds);
}

static void add_parts(json_t *json, const Run *run)
{
    json_object_set_new(json, "scene", scene_json(run));
    json_object_set_new(json, "bvh", tree_json(run));
    json_object_set_new(json, "settings", settings_json(run));
    json_object_set_new(json, "tiles", tiles_json(run));
    json_object_set_new(json, "samples", samples_json(run));
    json_object_set_new(json, "rays", rays_json(run));
    json_object_set_new(json, "tests", tests_json(run));
    json_object_set_new(json, "seconds", seconds_json(run));
    json_object_set_new(json, "frame_seconds", frames_json(run));
    json_object_set_new(json, "reference", reference_json(run));
    json_object_set_new(json, "certainty", certainty_json(run));
}

static json_t *report_json(const Run *run)
{
    const Report *report = &run->report;
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    json_t *json = json_pack("{s:i, s:s, s:b, s:s, s:{s:s, s:s}, s:{s:o, s:o}}", "schema",
                             SCHEMA_VERSION, "version", CLRT_VERSION, "complete", report->complete,
                             "pixel_hash", report->pixel_hash, "device", "name",
                             run->session.device.name, "driver", run->session.device.version,
                             "bytes", "uploaded", json_count(run->report.drawn.upload_size),
                             "peak_memory", json_count((uint64_t)usage.ru_maxrss * 1024));
    if (json != NULL)
        add_parts(json, run);
    return json;
}

bool report_write_json(const Run *run, const char *path, Error *error)
{
    return json_file_write(report_json(run), path, error);
}
