// SPDX-License-Identifier: MIT
// Writes the report as text, and as JSON with Jansson.
#include "cli/report.h"

#include "accel/bvh.h"
#include "image/json_file.h"
#include "render/renderer.h"

#include <inttypes.h>
#include <string.h>
#include <sys/resource.h>

#define SCHEMA_VERSION 1

static uint64_t ray_count(const Report *report)
{
    return report->tallies[TALLY_CAMERA_RAYS] + report->tallies[TALLY_SHADOW_RAYS] +
           report->tallies[TALLY_REFLECTED_RAYS];
}

static double per_ray(const Report *report, TallyKind kind)
{
    const uint64_t rays = ray_count(report);
    return rays == 0 ? 0 : (double)report->tallies[kind] / (double)rays;
}

static double samples_per_pixel(const Report *report)
{
    return report->pixels == 0 ? 0 : (double)report->samples / (double)report->pixels;
}

const char *report_tree_name(const Report *report)
{
    if (report->bvh_nodes == 0)
        return "none";
    return report->options->builder == BVH_MIDPOINT ? "midpoint" : "sah";
}

void report_count_scene(Report *report, const Scene *scene, const Bvh *bvh)
{
    memcpy(report->scene_hash, scene->hash, sizeof report->scene_hash);
    memcpy(report->mesh_hash, scene->mesh_hash, sizeof report->mesh_hash);
    report->lights = (uint32_t)scene->lights.count;
    report->spheres = (uint32_t)scene->spheres.count;
    report->triangles = (uint32_t)scene_triangle_count(scene);
    for (size_t i = 0; i < scene->objects.count; i++)
        report->dropped_triangles += scene->objects.data[i].mesh.dropped_count;
    report->bvh_nodes = bvh->node_count;
    report->bvh_leaves = bvh->leaf_count;
    report->bvh_depth = bvh->depth;
    report->bvh_largest_leaf = bvh->largest_leaf;
    memcpy(report->bvh_inner, bvh->inner_counts, sizeof report->bvh_inner);
}

void report_write_text(const Report *report, FILE *stream)
{
    if (report->options->resume)
        fprintf(stream,
                "%" PRIu64 " of %" PRIu64 " tiles were there: time and counts are of the others\n",
                report->settings->ready_tiles, tile_count(report->settings));
    fprintf(stream, "%.3f seconds\n", report->trace);
    fprintf(stream, "%" PRIu64 " samples, %.2f per pixel\n", report->samples,
            samples_per_pixel(report));
    if (report->estimate > 0)
        fprintf(stream,
                "error: about %.2g %%, at most %.2g %% with 95 %% confidence, of which at most "
                "%.2g %% for %u levels\n",
                100 * report->estimate, 100 * report->bound, 100 * report->truncation,
                report->settings->max_level);
    fprintf(stream,
            "%" PRIu64 " rays: %" PRIu64 " camera, %" PRIu64 " shadow, %" PRIu64 " reflected\n",
            ray_count(report), report->tallies[TALLY_CAMERA_RAYS],
            report->tallies[TALLY_SHADOW_RAYS], report->tallies[TALLY_REFLECTED_RAYS]);
    fprintf(stream, "%" PRIu64 " triangle tests, %.2f per ray\n",
            report->tallies[TALLY_TRIANGLE_TESTS], per_ray(report, TALLY_TRIANGLE_TESTS));
    fprintf(stream, "%" PRIu64 " box tests, %.2f per ray\n", report->tallies[TALLY_BOX_TESTS],
            per_ray(report, TALLY_BOX_TESTS));
    const uint64_t *pixels = report->certainty.pixels;
    if (aov_needs(report->options->aovs, AOV_NEEDS_CERTAINTY))
        fprintf(stream,
                "%" PRIu64 " pixels certified, %" PRIu64 " repaired, %" PRIu64 " open, %.3f s\n",
                pixels[CERTAINTY_CERTIFIED], pixels[CERTAINTY_REPAIRED], pixels[CERTAINTY_OPEN],
                report->certainty.seconds);
}

void report_write_error(const Report *report, FILE *stream)
{
    const ReferenceResult *result = &report->reference;
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
    fprintf(stream, "reference: fp64, %u samples a pixel, RMSE %.2g by itself, %.2f s\n",
            result->samples, result->own_error, result->seconds);
}

static json_t *integer(uint64_t value)
{
    return json_integer((json_int_t)value);
}

static json_t *rays_json(const Report *report)
{
    return json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o}", "camera", integer(report->tallies[TALLY_CAMERA_RAYS]),
        "camera_hits", integer(report->tallies[TALLY_CAMERA_HITS]), "shadow",
        integer(report->tallies[TALLY_SHADOW_RAYS]), "reflected",
        integer(report->tallies[TALLY_REFLECTED_RAYS]), "total", integer(ray_count(report)),
        "shaded_points", integer(report->tallies[TALLY_SHADED_POINTS]));
}

static json_t *tests_json(const Report *report)
{
    return json_pack("{s:o, s:o, s:o, s:f, s:f, s:f}", "triangle",
                     integer(report->tallies[TALLY_TRIANGLE_TESTS]), "box",
                     integer(report->tallies[TALLY_BOX_TESTS]), "sphere",
                     integer(report->tallies[TALLY_SPHERE_TESTS]), "triangle_per_ray",
                     per_ray(report, TALLY_TRIANGLE_TESTS), "box_per_ray",
                     per_ray(report, TALLY_BOX_TESTS), "sphere_per_ray",
                     per_ray(report, TALLY_SPHERE_TESTS));
}

static json_t *seconds_json(const Report *report)
{
    return json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "parse", report->parse,
                     "load", report->load, "build", report->build, "device", report->device,
                     "upload", report->upload, "kernel_build", report->kernel_build, "trace",
                     report->trace, "write", report->write, "total", report->total);
}

static json_t *frames_json(const Report *report)
{
    json_t *list = json_array();
    for (uint32_t frame = 0; frame < report->frame_count; frame++)
        json_array_append_new(list, json_real(report->frame_seconds[frame]));
    return list;
}

static json_t *scene_json(const Report *report)
{
    char hash[SCENE_HASH_SIZE], mesh_hash[SCENE_HASH_SIZE];
    scene_hash_name(report->scene_hash, hash);
    scene_hash_name(report->mesh_hash, mesh_hash);
    return json_pack("{s:o, s:s, s:s, s:o, s:o, s:o, s:o}", "path",
                     json_file_path(report->options->scene_path), "hash", hash, "mesh_hash",
                     mesh_hash, "lights", integer(report->lights), "spheres",
                     integer(report->spheres), "triangles", integer(report->triangles),
                     "dropped_triangles", integer(report->dropped_triangles));
}

static json_t *inner_nodes_json(const Report *report)
{
    json_t *list = json_array();
    for (uint32_t depth = 0; depth + 1 < report->bvh_depth; depth++)
        json_array_append_new(list, integer(report->bvh_inner[depth]));
    return list;
}

static json_t *tree_json(const Report *report)
{
    return json_pack("{s:s, s:o, s:o, s:o, s:o, s:o}", "builder", report_tree_name(report), "nodes",
                     integer(report->bvh_nodes), "leaves", integer(report->bvh_leaves), "depth",
                     integer(report->bvh_depth), "inner_nodes", inner_nodes_json(report),
                     "largest_leaf", integer(report->bvh_largest_leaf));
}

static json_t *settings_json(const Report *report)
{
    const RenderSettings *settings = report->settings;
    return json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:f, s:[oo], s:[oo], s:b, s:s, s:s, s:o, s:s}", "view",
        integer(report->view), "width", integer(render_whole_width(settings)), "height",
        integer(render_whole_height(settings)), "crop", crop_json(settings), "samples",
        integer(settings->samples), "max_level", integer(settings->max_level), "truncation_bound",
        report->truncation, "tile", integer(settings->tile_width), integer(settings->tile_height),
        "work_group", integer(settings->group_width), integer(settings->group_height),
        "specialized", report->specialized, "kernel", kernel_family_name(report->choice->family),
        "nodes", kernel_nodes_name(report->choice->nodes), "lanes", integer(report->choice->lanes),
        "precision", kernel_precision_name(report->choice->precision));
}

static json_t *samples_json(const Report *report)
{
    return json_pack("{s:o, s:f, s:f, s:f, s:f, s:b}", "total", integer(report->samples),
                     "per_pixel", samples_per_pixel(report), "contrast", report->contrast,
                     "error_estimate", report->estimate, "error_bound", report->bound,
                     "goal_reached", !report->goal_missed);
}

// Returns null for refined pictures, which are drawn in several passes without tiles.
static json_t *tiles_json(const Report *report)
{
    const uint64_t found = report->settings->ready_tiles;
    if (options_are_adaptive(report->options))
        return json_null();
    return json_pack("{s:o, s:o, s:o}", "total", integer(tile_count(report->settings)), "found",
                     integer(found), "drawn", integer(report->tiles_done - found));
}

static json_t *reference_json(const Report *report)
{
    const ReferenceResult *result = &report->reference;
    const Difference *difference = &result->difference;
    const double pixels = (double)difference->pixels;
    if (result->samples == 0)
        return json_null();
    return json_pack("{s:o, s:f, s:f, s:f, s:f, s:f, s:f}", "samples", integer(result->samples),
                     "rmse", difference->rmse, "own_error", result->own_error, "maximum",
                     difference->maximum, "share_off_by_1", (double)difference->off_by_1 / pixels,
                     "share_off_by_4", (double)difference->off_by_4 / pixels, "seconds",
                     result->seconds);
}

static json_t *certainty_json(const Report *report)
{
    const uint64_t *pixels = report->certainty.pixels;
    if (!aov_needs(report->options->aovs, AOV_NEEDS_CERTAINTY))
        return json_null();
    return json_pack("{s:o, s:o, s:o, s:f}", "certified", integer(pixels[CERTAINTY_CERTIFIED]),
                     "repaired", integer(pixels[CERTAINTY_REPAIRED]), "open",
                     integer(pixels[CERTAINTY_OPEN]), "seconds", report->certainty.seconds);
}

static void add_parts(json_t *json, const Report *report)
{
    json_object_set_new(json, "scene", scene_json(report));
    json_object_set_new(json, "bvh", tree_json(report));
    json_object_set_new(json, "settings", settings_json(report));
    json_object_set_new(json, "tiles", tiles_json(report));
    json_object_set_new(json, "samples", samples_json(report));
    json_object_set_new(json, "rays", rays_json(report));
    json_object_set_new(json, "tests", tests_json(report));
    json_object_set_new(json, "seconds", seconds_json(report));
    json_object_set_new(json, "frame_seconds", frames_json(report));
    json_object_set_new(json, "reference", reference_json(report));
    json_object_set_new(json, "certainty", certainty_json(report));
}

static json_t *report_json(const Report *report)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    json_t *json = json_pack(
        "{s:i, s:s, s:b, s:s, s:{s:s, s:s}, s:{s:o, s:o}}", "schema", SCHEMA_VERSION, "version",
        CLRT_VERSION, "complete", report->complete, "pixel_hash", report->pixel_hash, "device",
        "name", report->device_name, "driver", report->device_version, "bytes", "uploaded",
        integer(report->upload_size), "peak_memory", integer((uint64_t)usage.ru_maxrss * 1024));
    if (json != NULL)
        add_parts(json, report);
    return json;
}

bool report_write_json(const Report *report, const char *path, Error *error)
{
    return json_file_write(report_json(report), path, error);
}
