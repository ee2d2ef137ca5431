// SPDX-License-Identifier: MIT
// Lists the fields of a picture's report. JSON contains all fields, and the text contains some.
#include "cli/report.h"

#include "image/json_file.h"

#include <stdio.h>
#include <strings.h>
#include <sys/resource.h>

static double ratio(uint64_t part, uint64_t whole)
{
    return whole == 0 ? 0 : (double)part / (double)whole;
}

static uint64_t ray_count(const uint64_t *tallies)
{
    return tallies[TALLY_CAMERA_RAYS] + tallies[TALLY_SHADOW_RAYS] + tallies[TALLY_REFLECTED_RAYS];
}

// Returns the name of the tree's builder as in --tune bvh, or "none" if there is no tree.
static const char *tree_name(const Picture *picture)
{
    if (picture->form->stages.bvh.node_count == 0)
        return "none";
    return picture->session->settings.wanted.tree == CLRT_TREE_MIDPOINT ? "midpoint" : "sah";
}

static json_t *repetitions_json(const Picture *picture)
{
    json_t *list = json_array();
    for (uint32_t i = 0; i < picture->repetition_count; i++)
        json_array_append_new(list, json_real(picture->repetition_seconds[i]));
    return list;
}

static json_t *inner_nodes_json(const Bvh *tree)
{
    json_t *list = json_array();
    for (uint32_t depth = 0; depth + 1 < tree->depth; depth++)
        json_array_append_new(list, json_count(tree->inner_counts[depth]));
    return list;
}

static json_t *tree_json(const Picture *picture)
{
    const Bvh *tree = &picture->form->stages.bvh;
    return JSON(FIELD("builder", tree_name(picture)), FIELD("nodes", tree->node_count),
                FIELD("leaves", tree->leaf_count), FIELD("depth", tree->depth),
                FIELD("inner_nodes", inner_nodes_json(tree)),
                FIELD("largest_leaf", tree->largest_leaf));
}

static json_t *scene_json(const Picture *picture)
{
    char hash[SCENE_HASH_SIZE], mesh_hash[SCENE_HASH_SIZE];
    const Scene *scene = picture->scene;
    scene_hash_name(scene->hash, hash);
    scene_hash_name(scene->mesh_hash, mesh_hash);
    return JSON(FIELD("path", picture->options->scene_path), FIELD("hash", hash),
                FIELD("mesh_hash", mesh_hash), FIELD("lights", scene->lights.count),
                FIELD("spheres", scene->spheres.count),
                FIELD("triangles", scene_triangle_count(scene)),
                FIELD("dropped_triangles", scene_dropped_count(scene)));
}

static json_t *settings_json(const Picture *picture)
{
    const RenderSettings *settings = &picture->request.settings;
    const KernelChoice *choice = &picture->session->choice;
    const uint32_t *group = picture->drawn.group;
    return JSON(FIELD("view", picture->view), FIELD("width", render_whole_width(settings)),
                FIELD("height", render_whole_height(settings)), FIELD("crop", crop_json(settings)),
                FIELD("samples", settings->samples), FIELD("max_level", settings->max_level),
                FIELD("truncation_bound", picture->drawn.facts.truncation),
                FIELD("tile", json_two(settings->tile_width, settings->tile_height)),
                FIELD("work_group", json_two(group[0], group[1])),
                FIELD("specialized", picture->drawn.is_special),
                FIELD("kernel", kernel_family_name(choice->family)),
                FIELD("nodes", kernel_nodes_name(choice->nodes)), FIELD("lanes", choice->lanes),
                FIELD("precision", kernel_precision_name(choice->precision)));
}

// Returns JSON's null for pictures with a goal, which are not drawn tile by tile.
static json_t *tiles_json(const Picture *picture)
{
    const uint64_t found = picture->request.settings.ready_tiles;
    if (goal_is_given(&picture->options->picture))
        return json_null();
    return JSON(FIELD("total", tile_count(&picture->request.settings)), FIELD("found", found),
                FIELD("drawn", picture->drawn.progress.tiles_done - found));
}

static json_t *samples_json(const PictureResult *drawn, double contrast)
{
    const ClrtResult *facts = &drawn->facts;
    return JSON(FIELD("total", facts->sample_count),
                FIELD("per_pixel", ratio(facts->sample_count, drawn->pixels)),
                FIELD("contrast", contrast), FIELD("error_estimate", facts->error),
                FIELD("error_bound", facts->error_bound),
                FIELD("goal_reached", (bool)!facts->goal_missed),
                FIELD("smallest_feature", facts->smallest_feature));
}

static json_t *rays_json(const uint64_t *tallies)
{
    return JSON(FIELD("camera", tallies[TALLY_CAMERA_RAYS]),
                FIELD("camera_hits", tallies[TALLY_CAMERA_HITS]),
                FIELD("shadow", tallies[TALLY_SHADOW_RAYS]),
                FIELD("reflected", tallies[TALLY_REFLECTED_RAYS]),
                FIELD("total", ray_count(tallies)),
                FIELD("shaded_points", tallies[TALLY_SHADED_POINTS]));
}

static json_t *tests_json(const uint64_t *tallies)
{
    const uint64_t rays = ray_count(tallies), triangle = tallies[TALLY_TRIANGLE_TESTS],
                   box = tallies[TALLY_BOX_TESTS], sphere = tallies[TALLY_SPHERE_TESTS];
    return JSON(FIELD("triangle", triangle), FIELD("box", box), FIELD("sphere", sphere),
                FIELD("triangle_per_ray", ratio(triangle, rays)),
                FIELD("box_per_ray", ratio(box, rays)),
                FIELD("sphere_per_ray", ratio(sphere, rays)));
}

static json_t *seconds_json(const Picture *picture)
{
    return JSON(FIELD("parse", picture->stages.parse), FIELD("load", picture->stages.load),
                FIELD("build", picture->stages.build),
                FIELD("device", picture->session->device_seconds),
                FIELD("upload", picture->drawn.upload_seconds),
                FIELD("kernel_build", picture->drawn.build_seconds),
                FIELD("trace", picture->repetition_seconds[0]),
                FIELD("write", picture->write_seconds), FIELD("total", picture->total_seconds));
}

static json_t *reference_json(const MeasuredReference *reference)
{
    const Difference *difference = &reference->difference;
    const uint64_t pixels = difference->pixels;
    if (reference->samples == 0)
        return json_null();
    return JSON(FIELD("samples", reference->samples), FIELD("rmse", difference->rmse),
                FIELD("own_error", reference->own_error), FIELD("maximum", difference->maximum),
                FIELD("maximum_at", json_two(difference->maximum_x, difference->maximum_y)),
                FIELD("share_off_by_1", ratio(difference->off_by_1, pixels)),
                FIELD("share_off_by_4", ratio(difference->off_by_4, pixels)),
                FIELD("seconds", reference->seconds));
}

static json_t *certainty_json(const Picture *picture)
{
    const uint64_t *pixels = picture->drawn.certainty.counts;
    if (!aov_needs(picture->options->aovs, AOV_NEEDS_CERTAINTY))
        return json_null();
    return JSON(FIELD("certified", pixels[CERTAINTY_CERTIFIED]),
                FIELD("repaired", pixels[CERTAINTY_REPAIRED]),
                FIELD("open", pixels[CERTAINTY_OPEN]),
                FIELD("seconds", picture->certainty_seconds));
}

static json_t *report_json(const Picture *picture)
{
    struct rusage usage;
    const Device *device = &picture->session->device;
    const uint64_t *tallies = picture->drawn.progress.tallies;
    getrusage(RUSAGE_SELF, &usage);
    const uint64_t peak = (uint64_t)usage.ru_maxrss * 1024;
    return REPORT(
        1, FIELD("complete", picture->complete), FIELD("pixel_hash", picture->pixel_hash),
        FIELD("device",
              JSON(FIELD("name", device->facts.name), FIELD("driver", device->facts.driver))),
        FIELD("bytes",
              JSON(FIELD("uploaded", picture->drawn.upload_size), FIELD("peak_memory", peak))),
        FIELD("scene", scene_json(picture)), FIELD("bvh", tree_json(picture)),
        FIELD("settings", settings_json(picture)), FIELD("cached", picture->drawn.facts.cached),
        FIELD("tiles", tiles_json(picture)),
        FIELD("samples", samples_json(&picture->drawn, picture->options->picture.contrast)),
        FIELD("rays", rays_json(tallies)), FIELD("tests", tests_json(tallies)),
        FIELD("seconds", seconds_json(picture)), FIELD("frame_seconds", repetitions_json(picture)),
        FIELD("reference", reference_json(&picture->reference)),
        FIELD("certainty", certainty_json(picture)));
}

static void print_error(const Picture *picture, const json_t *json, FILE *stream)
{
    json_print(json,
               "error: about {samples.error_estimate .2g%}, at most {samples.error_bound .2g%} "
               "with 95 % confidence",
               stream);
    if (picture->request.includes_truncated && picture->request.truncated > 0)
        json_print(json,
                   ", including at most {settings.truncation_bound .2g%} because rays end at level "
                   "{settings.max_level}",
                   stream);
    fputs("\n", stream);
}

void report_write_text(const Picture *picture, FILE *stream)
{
    json_t *json = report_json(picture);
    if (picture->options->resume)
        json_print(json,
                   "{tiles.found} of {tiles.total} tiles were finished before: time and counts "
                   "cover the others\n",
                   stream);
    json_print(json,
               "{seconds.trace .3f} seconds\n"
               "{samples.total} samples, {samples.per_pixel .2f} per pixel\n"
               "smallest disk found with a probability of 95 %: {samples.smallest_feature .2f} "
               "pixels wide\n",
               stream);
    if (picture->drawn.facts.error > 0)
        print_error(picture, json, stream);
    else if (picture->request.level_bound > 0)
        json_print(json,
                   "error of at most {settings.truncation_bound .2g%} because rays end at level "
                   "{settings.max_level}\n",
                   stream);
    json_print(json,
               "{rays.total} rays: {rays.camera} camera, {rays.shadow} shadow, {rays.reflected} "
               "reflected\n"
               "{tests.triangle} triangle tests, {tests.triangle_per_ray .2f} per ray\n"
               "{tests.box} box tests, {tests.box_per_ray .2f} per ray\n",
               stream);
    json_print(json_object_get(json, "certainty"),
               "{certified} pixels certified, {repaired} repaired, {open} open, {seconds .3f} s\n",
               stream);
    json_decref(json);
}

void report_write_setup(const Picture *picture, FILE *stream)
{
    json_t *json = report_json(picture);
    json_print(
        json,
        "scene: {scene.triangles} triangles, {scene.spheres} spheres, {scene.lights} lights; "
        "{scene.dropped_triangles} triangles dropped\n"
        "tree: {bvh.nodes} nodes, {bvh.leaves} leaves of at most {bvh.largest_leaf} "
        "triangles, {bvh.depth} levels\n"
        "device: {device.name}, driver {device.driver}, ",
        stream);
    fprintf(stream, "%u compute units\n", picture->session->device.facts.compute_units);
    json_print(json, "kernels: {settings.kernel}, {settings.nodes} nodes, {settings.precision}, ",
               stream);
    fputs(picture->drawn.is_special ? "specialized" : "general", stream);
    fputs(picture->drawn.facts.cached ? ", cached" : ", compiled", stream);
    json_print(json, ", ready in {seconds.kernel_build .3f} s; uploaded {bytes.uploaded} bytes\n",
               stream);
    json_decref(json);
}

void report_write_error(const MeasuredReference *reference, FILE *stream)
{
    json_t *json = reference_json(reference);
    json_print(json,
               "RMSE {rmse .4g} ({rmse .3g%}), largest difference "
               "{maximum .4g} at {maximum_at.0},{maximum_at.1}; "
               "off by more than 1/255: {share_off_by_1 .4g%} of the pixels, 4/255: "
               "{share_off_by_4 .4g%}\n"
               "reference: for fp64, {samples} samples a pixel, RMSE of the "
               "reference {own_error .2g}, {seconds .2f} s\n",
               stream);
    json_decref(json);
}

bool report_write_json(const Picture *picture, const char *path, Error *error)
{
    return json_file_write(report_json(picture), path, error);
}

// The following functions fill the metadata of a picture's file. The file omits settings that
// change no pixel. Parts and unfinished pictures also record their tiles.

static json_t *stored_samples_json(const Picture *picture)
{
    return goal_is_given(&picture->options->picture)
               ? json_string("adaptive")
               : json_count(picture->request.settings.samples);
}

static json_t *stored_settings_json(const Picture *picture)
{
    const RenderSettings *settings = &picture->request.settings;
    const Options *options = picture->options;
    const bool is_unfinished = !picture->complete && !goal_is_given(&options->picture);
    // The counts of tests depend on the tree's builder and on the node layout.
    const bool counts_tests = aov_needs(options->aovs, AOV_NEEDS_TESTS);
    return JSON(
        FIELD("view", picture->view), FIELD("width", render_whole_width(settings)),
        FIELD("height", render_whole_height(settings)),
        FIELD("samples", stored_samples_json(picture)), FIELD("max_level", settings->max_level),
        FIELD("encode", options->encoding == ENCODE_SRGB ? "srgb" : "raw"),
        FIELD("precision", kernel_precision_name(picture->session->choice.precision)),
        FIELD_IF(counts_tests, "bvh", tree_name(picture)),
        FIELD_IF(counts_tests, "nodes", kernel_nodes_name(picture->session->choice.nodes)),
        FIELD_IF(options->exposure != 0, "exposure", options->exposure),
        FIELD_IF(picture->turned > 0, "turned", picture->turned),
        FIELD_IF(render_is_part(settings), "crop", crop_json(settings)),
        FIELD_IF(options->picture.contrast > 0, "contrast", options->picture.contrast),
        FIELD_IF(options->picture.error > 0, "error", options->picture.error),
        FIELD_IF(options->picture.seconds > 0, "time", options->picture.seconds),
        FIELD_IF(settings->parts > 0, "part", json_two(settings->part + 1, settings->parts)),
        FIELD_IF(settings->parts > 0 || is_unfinished, "tile",
                 json_two(settings->tile_width, settings->tile_height)),
        FIELD_IF(is_unfinished, "tiles_done", picture->drawn.progress.tiles_done));
}

static void set(Provenance *provenance, StoredText kind, const char *value)
{
    snprintf(provenance->texts[kind], STORED_TEXT_SIZE, "%s", value);
}

void report_fill_provenance(Provenance *provenance, const Picture *picture)
{
    json_t *settings = stored_settings_json(picture);
    set(provenance, STORED_VERSION, CLRT_VERSION);
    scene_hash_name(picture->scene->hash, provenance->texts[STORED_SCENE_HASH]);
    scene_hash_name(picture->scene->mesh_hash, provenance->texts[STORED_MESH_HASH]);
    provenance_write_settings(provenance->texts[STORED_SETTINGS], settings);
    set(provenance, STORED_DEVICE, picture->session->device.facts.name);
    set(provenance, STORED_DRIVER, picture->session->device.facts.driver);
    set(provenance, STORED_PIXEL_HASH, picture->pixel_hash);
    set(provenance, STORED_COMPLETE, picture->complete ? "yes" : "no");
    json_decref(settings);
}

bool report_print_hash(const Options *options, const char *hash, Error *error)
{
    const char *expected = options->expected_hash;
    if (options->hash && expected == NULL)
        printf("%s\n", hash);
    return expected == NULL || strcasecmp(hash, expected) == 0 ||
           error_set(error, "the hash of the pixels is %s, not the expected %s", hash, expected);
}
