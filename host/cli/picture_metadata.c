// SPDX-License-Identifier: MIT
// Fills the metadata of a picture. Settings that cannot change a pixel are left out, so that they
// do not change the file. Only parts and unfinished pictures also record their tiles.
#include "cli/picture.h"

#include "image/json_file.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static json_t *samples_json(const Run *run)
{
    return options_are_adaptive(run->options) ? json_string("adaptive")
                                              : json_count(run->settings.samples);
}

// Test counts depend on the tree; colors do not.
static void add_tree(json_t *json, const Run *run)
{
    if (!aov_needs(run->options->aovs, AOV_NEEDS_TESTS))
        return;
    json_object_set_new(json, "bvh", json_string(report_tree_name(run)));
    json_object_set_new(json, "nodes", json_string(kernel_nodes_name(run->session.choice.nodes)));
}

static json_t *settings_json(const Run *run)
{
    const RenderSettings *settings = &run->settings;
    const Options *options = run->options;
    const bool is_unfinished = !run->report.complete && !options_are_adaptive(options);
    json_t *json =
        json_pack("{s:o, s:o, s:o, s:o, s:o, s:s, s:s}", "view", json_count(run->report.view),
                  "width", json_count(render_whole_width(settings)), "height",
                  json_count(render_whole_height(settings)), "samples", samples_json(run),
                  "max_level", json_count(settings->max_level), "encode",
                  options->encoding == ENCODE_SRGB ? "srgb" : "raw", "precision",
                  kernel_precision_name(run->session.choice.precision));
    add_tree(json, run);
    if (options->exposure != 0)
        json_object_set_new(json, "exposure", json_real(options->exposure));
    if (run->report.turned > 0)
        json_object_set_new(json, "turned", json_real(run->report.turned));
    if (render_is_part(settings))
        json_object_set_new(json, "crop", crop_json(settings));
    if (options->contrast > 0)
        json_object_set_new(json, "contrast", json_real(options->contrast));
    if (options->error_goal > 0)
        json_object_set_new(json, "error", json_real(options->error_goal));
    if (options->time_goal > 0)
        json_object_set_new(json, "time", json_real(options->time_goal));
    if (settings->parts > 0)
        json_object_set_new(json, "part", json_pair(settings->part + 1, settings->parts));
    if (settings->parts > 0 || is_unfinished)
        json_object_set_new(json, "tile", json_pair(settings->tile_width, settings->tile_height));
    if (is_unfinished)
        json_object_set_new(json, "tiles_done", json_count(run->report.drawn.progress.tiles_done));
    return json;
}

static void set(Provenance *provenance, StoredText kind, const char *value)
{
    snprintf(provenance->texts[kind], STORED_TEXT_SIZE, "%s", value);
}

void report_fill_provenance(Provenance *provenance, const Run *run)
{
    json_t *settings = settings_json(run);
    set(provenance, STORED_VERSION, CLRT_VERSION);
    scene_hash_name(run->scene.hash, provenance->texts[STORED_SCENE_HASH]);
    scene_hash_name(run->scene.mesh_hash, provenance->texts[STORED_MESH_HASH]);
    provenance_write_settings(provenance->texts[STORED_SETTINGS], settings);
    set(provenance, STORED_DEVICE, run->session.device.name);
    set(provenance, STORED_DRIVER, run->session.device.version);
    set(provenance, STORED_PIXEL_HASH, run->report.pixel_hash);
    set(provenance, STORED_COMPLETE, run->report.complete ? "yes" : "no");
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
