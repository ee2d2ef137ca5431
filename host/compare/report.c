// SPDX-License-Identifier: MIT
// JSON contains shares as fractions. The text contains percent, except in the lines on limits.
#include "compare/difference.h"

#include "image/json_file.h"

#include <inttypes.h>

#define SCHEMA_VERSION 1

bool comparison_is_kept(const Comparison *comparison)
{
    for (int kind = 0; kind < LIMIT_KINDS; kind++)
        if (comparison->limits->given[kind] &&
            !limit_is_kept(comparison->limits, (LimitKind)kind, &comparison->difference))
            return false;
    return true;
}

static void write_count(const Comparison *comparison, const char *what, uint64_t count,
                        FILE *stream)
{
    fprintf(stream, "%s %" PRIu64 " pixels (%.4g %%)\n", what, count,
            100 * (double)count / (double)comparison->difference.pixels);
}

// Returns a cause's share of the mean square error, from 0 to 1.
static double share_of(const Comparison *comparison, CauseKind kind)
{
    double sum = 0;
    for (int i = 0; i < CAUSE_KINDS; i++)
        sum += comparison->causes.squares[i];
    return sum > 0 ? comparison->causes.squares[kind] / sum : 0;
}

static void write_causes(const Comparison *comparison, FILE *stream)
{
    if (!comparison->causes.known || comparison->difference.maximum <= 0)
        return;
    fputs("of the mean square error:\n", stream);
    for (int i = 0; i < CAUSE_KINDS; i++)
        if (comparison->causes.pixels[i] > 0)
            fprintf(stream, "  %-10s %5.1f %% in %" PRIu64 " pixels: %s\n", cause_names[i],
                    100 * share_of(comparison, (CauseKind)i), comparison->causes.pixels[i],
                    cause_meanings[i]);
}

static void write_limits(const Comparison *comparison, FILE *stream)
{
    for (int kind = 0; kind < LIMIT_KINDS; kind++) {
        if (!comparison->limits->given[kind])
            continue;
        const bool kept =
            limit_is_kept(comparison->limits, (LimitKind)kind, &comparison->difference);
        fprintf(stream, "%s %s %.6g, the limit is %.6g\n",
                kept ? "kept:" : "BROKEN:", limit_names[kind],
                limit_measured((LimitKind)kind, &comparison->difference),
                comparison->limits->values[kind]);
    }
}

void comparison_write_text(const Comparison *comparison, FILE *stream)
{
    static const char *const colors[] = {"red", "green", "blue"};
    const Difference *difference = &comparison->difference;
    fprintf(stream, "%s and %s: %u x %u pixels\n", comparison->pair.paths[0],
            comparison->pair.paths[1], difference->width, difference->height);
    fprintf(stream, "RMSE %.6g (%.4g %%), PSNR %.4g dB\n", difference->rmse, 100 * difference->rmse,
            difference_psnr(difference));
    if (difference->maximum > 0)
        fprintf(stream, "largest difference %.6g, in %s at %u,%u\n", difference->maximum,
                colors[difference->maximum_color], difference->maximum_x, difference->maximum_y);
    else
        fputs("all colors are equal\n", stream);
    write_count(comparison, "off by more than 1/255:", difference->off_by_1, stream);
    write_count(comparison, "off by more than 4/255:", difference->off_by_4, stream);
    if (difference->has_hits)
        write_count(comparison, "other primitives hit first:", difference->wrong_hits, stream);
    write_causes(comparison, stream);
    write_limits(comparison, stream);
}

static json_t *count_json(const Comparison *comparison, uint64_t count)
{
    return json_pack("{s:o, s:f}", "pixels", json_count(count), "share",
                     (double)count / (double)comparison->difference.pixels);
}

static json_t *maximum_json(const Difference *difference)
{
    return json_pack("{s:f, s:i, s:i, s:i}", "value", difference->maximum, "x",
                     (int)difference->maximum_x, "y", (int)difference->maximum_y, "color",
                     (int)difference->maximum_color);
}

static json_t *causes_json(const Comparison *comparison)
{
    const Causes *causes = &comparison->causes;
    json_t *all = causes->known ? json_object() : json_null();
    for (int i = 0; causes->known && i < CAUSE_KINDS; i++)
        json_object_set_new(all, cause_names[i],
                            json_pack("{s:o, s:f, s:f}", "pixels", json_count(causes->pixels[i]),
                                      "mean_square", causes->squares[i], "share",
                                      share_of(comparison, (CauseKind)i)));
    return all;
}

static json_t *limits_json(const Comparison *comparison)
{
    json_t *all = json_object();
    for (int kind = 0; kind < LIMIT_KINDS; kind++)
        if (comparison->limits->given[kind])
            json_object_set_new(
                all, limit_names[kind],
                json_pack(
                    "{s:f, s:o, s:b}", "limit", comparison->limits->values[kind], "measured",
                    json_finite(limit_measured((LimitKind)kind, &comparison->difference)), "kept",
                    limit_is_kept(comparison->limits, (LimitKind)kind, &comparison->difference)));
    return all;
}

bool comparison_write_json(const Comparison *comparison, const char *path, Error *error)
{
    const Difference *difference = &comparison->difference;
    json_t *hits =
        difference->has_hits ? count_json(comparison, difference->wrong_hits) : json_null();
    json_t *root = json_pack(
        "{s:i, s:s, s:[oo], s:i, s:i, s:f, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b}", "schema",
        SCHEMA_VERSION, "version", CLRT_VERSION, "files", json_file_path(comparison->pair.paths[0]),
        json_file_path(comparison->pair.paths[1]), "width", (int)difference->width, "height",
        (int)difference->height, "rmse", difference->rmse, "psnr",
        json_finite(difference_psnr(difference)), "maximum", maximum_json(difference), "off_by_1",
        count_json(comparison, difference->off_by_1), "off_by_4",
        count_json(comparison, difference->off_by_4), "wrong_hits", hits, "causes",
        causes_json(comparison), "limits", limits_json(comparison), "kept",
        comparison_is_kept(comparison));
    return json_file_write(root, path, error);
}
