// SPDX-License-Identifier: MIT
// Settings are those that the picture depends on, none of those that change no bit: files of the
// same picture are equal.
#include "cli/provenance.h"

#include "base/number.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
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

static json_t *samples_json(const Report *report)
{
    return options_are_adaptive(report->options) ? json_string("adaptive")
                                                 : integer(report->settings->samples);
}

static void write_settings(char *text, const Report *report)
{
    const RenderSettings *settings = report->settings;
    const Options *options = report->options;
    json_t *json = json_pack("{s:o, s:o, s:o, s:o, s:o, s:s, s:s}", "view", integer(options->view),
                             "width", integer(render_whole_width(settings)), "height",
                             integer(render_whole_height(settings)), "samples",
                             samples_json(report), "max_level", integer(settings->max_level),
                             "encode", options->encoding == ENCODE_SRGB ? "srgb" : "raw",
                             "precision", kernel_precision_name(report->choice->precision));
    if (render_is_part(settings))
        json_object_set_new(json, "crop", crop_json(settings));
    if (options_are_adaptive(options))
        json_object_set_new(json, "contrast", json_real(report->contrast));
    const size_t length = json_dumpb(json, text, PROVENANCE_SETTINGS - 1,
                                     JSON_SORT_KEYS | JSON_COMPACT | JSON_REAL_PRECISION(6));
    text[length < PROVENANCE_SETTINGS ? length : 0] = '\0';
    json_decref(json);
}

static void add(Provenance *provenance, const char *name, const char *value)
{
    provenance->texts[provenance->count++] = (ImageText){name, value};
}

void provenance_make(Provenance *provenance, const Report *report)
{
    provenance->count = 0;
    scene_hash_name(report->scene_hash, provenance->scene_hash);
    scene_hash_name(report->mesh_hash, provenance->mesh_hash);
    write_settings(provenance->settings, report);
    add(provenance, "Software", "clrt " CLRT_VERSION);
    if (write_date(provenance->date, sizeof provenance->date))
        add(provenance, "DateTime", provenance->date);
    add(provenance, "clrt:version", CLRT_VERSION);
    add(provenance, "clrt:scene_hash", provenance->scene_hash);
    add(provenance, "clrt:mesh_hash", provenance->mesh_hash);
    add(provenance, "clrt:settings", provenance->settings);
    add(provenance, "clrt:device", report->device_name);
    add(provenance, "clrt:driver", report->device_version);
    add(provenance, "clrt:pixel_hash", report->pixel_hash);
    add(provenance, "clrt:complete", report->complete ? "yes" : "no");
}
