// SPDX-License-Identifier: MIT
// Settings are those that the picture depends on, none of those that change no bit: files of the
// same picture are equal.
#include "cli/provenance.h"

#include "base/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>

// The last second of the year 9999.
#define DATE_LAST 253402300799

static bool read_date(const char *text, int64_t *seconds)
{
    const char *end = text + strlen(text);
    return integer_parse(text, end, seconds) == end && *seconds >= 0 && *seconds <= DATE_LAST;
}

bool provenance_check_date(Error *error)
{
    int64_t seconds;
    const char *text = getenv("SOURCE_DATE_EPOCH");
    return text == NULL || read_date(text, &seconds) ||
           error_set(error, "SOURCE_DATE_EPOCH wants seconds since 1970, not '%s'", text);
}

// As EXIF, TIFF and EXR write it, in UTC.
static bool write_date(char *date, size_t size)
{
    struct tm parts;
    int64_t seconds;
    const char *text = getenv("SOURCE_DATE_EPOCH");
    if (text == NULL || !read_date(text, &seconds))
        return false;
    const time_t moment = (time_t)seconds;
    return gmtime_r(&moment, &parts) != NULL &&
           strftime(date, size, "%Y:%m:%d %H:%M:%S", &parts) > 0;
}

static json_t *integer(uint32_t value)
{
    return json_integer((json_int_t)value);
}

static json_t *pair_json(uint32_t one, uint32_t other)
{
    return json_pack("[oo]", integer(one), integer(other));
}

static json_t *samples_json(const Report *report)
{
    return options_are_adaptive(report->options) ? json_string("adaptive")
                                                 : integer(report->settings->samples);
}

// Counts of tests are of one tree, whatever the colors are the same with.
static void add_tree(json_t *json, const Report *report)
{
    if (!aov_needs(report->options->aovs, AOV_NEEDS_TESTS))
        return;
    json_object_set_new(json, "bvh", json_string(report_tree_name(report)));
    json_object_set_new(json, "nodes", json_string(kernel_nodes_name(report->choice->nodes)));
}

static json_t *settings_json(const Report *report)
{
    const RenderSettings *settings = report->settings;
    const Options *options = report->options;
    const bool is_unfinished = !report->complete && !options_are_adaptive(options);
    json_t *json = json_pack("{s:o, s:o, s:o, s:o, s:o, s:s, s:s}", "view", integer(report->view),
                             "width", integer(render_whole_width(settings)), "height",
                             integer(render_whole_height(settings)), "samples",
                             samples_json(report), "max_level", integer(settings->max_level),
                             "encode", options->encoding == ENCODE_SRGB ? "srgb" : "raw",
                             "precision", kernel_precision_name(report->choice->precision));
    add_tree(json, report);
    if (report->turned > 0)
        json_object_set_new(json, "turned", json_real(report->turned));
    if (render_is_part(settings))
        json_object_set_new(json, "crop", crop_json(settings));
    if (options_are_adaptive(options))
        json_object_set_new(json, "contrast", json_real(report->contrast));
    if (settings->parts > 0)
        json_object_set_new(json, "part", pair_json(settings->part + 1, settings->parts));
    if (settings->parts > 0 || is_unfinished)
        json_object_set_new(json, "tile", pair_json(settings->tile_width, settings->tile_height));
    if (is_unfinished)
        json_object_set_new(json, "tiles_done", json_integer((json_int_t)report->tiles_done));
    return json;
}

void provenance_write_settings(char text[STORED_TEXT_SIZE], const json_t *settings)
{
    const size_t length = json_dumpb(settings, text, STORED_TEXT_SIZE - 1,
                                     JSON_SORT_KEYS | JSON_COMPACT | JSON_REAL_PRECISION(6));
    text[length < STORED_TEXT_SIZE ? length : 0] = '\0';
}

static void set(Provenance *provenance, StoredText kind, const char *value)
{
    snprintf(provenance->texts[kind], STORED_TEXT_SIZE, "%s", value);
}

void provenance_fill(Provenance *provenance, const Report *report)
{
    json_t *settings = settings_json(report);
    set(provenance, STORED_VERSION, CLRT_VERSION);
    scene_hash_name(report->scene_hash, provenance->texts[STORED_SCENE_HASH]);
    scene_hash_name(report->mesh_hash, provenance->texts[STORED_MESH_HASH]);
    provenance_write_settings(provenance->texts[STORED_SETTINGS], settings);
    set(provenance, STORED_DEVICE, report->device_name);
    set(provenance, STORED_DRIVER, report->device_version);
    set(provenance, STORED_PIXEL_HASH, report->pixel_hash);
    set(provenance, STORED_COMPLETE, report->complete ? "yes" : "no");
    json_decref(settings);
}

static void add(Provenance *provenance, const char *name, const char *value)
{
    provenance->list[provenance->count++] = (ImageText){name, value};
}

void provenance_list(Provenance *provenance)
{
    provenance->count = 0;
    snprintf(provenance->software, sizeof provenance->software, "clrt %.40s",
             provenance->texts[STORED_VERSION]);
    add(provenance, "Software", provenance->software);
    if (write_date(provenance->date, sizeof provenance->date))
        add(provenance, "DateTime", provenance->date);
    for (int kind = 0; kind < STORED_TEXTS; kind++)
        add(provenance, stored_text_names[kind], provenance->texts[kind]);
}

bool provenance_tell_hash(const Options *options, const char *hash, Error *error)
{
    const char *expected = options->expected_hash;
    if (options->hash)
        printf("%s\n", hash);
    return expected == NULL || strcasecmp(hash, expected) == 0 ||
           error_set(error, "the hash of the pixels is %s, not the expected %s", hash, expected);
}
