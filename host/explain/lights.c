// SPDX-License-Identifier: MIT
// Prints the light that reaches a surface: a line for each light, or for all points of an area
// light.
#include "explain/lights.h"

#include "base/print.h"
#include "base/text.h"
#include "image/json_file.h"

#include <limits.h>

#define BRIEF_DIGITS 3

void explain_print(const ExplainReport *report, const json_t *json, const char *text, FILE *stream)
{
    json_print_digits(json, text, report->is_brief ? BRIEF_DIGITS : INT_MAX, stream);
}

void explain_print_detail(const ExplainReport *report, const json_t *json, const char *text,
                          FILE *stream)
{
    if (!report->is_brief)
        json_print(json, text, stream);
}

void explain_print_primitive(const ExplainReport *report, const json_t *primitive, FILE *stream)
{
    const char *path = json_string_value(json_object_get(primitive, "file"));
    json_print(primitive, "{kind} {number}", stream);
    if (path != NULL)
        print_text(stream, " of %s", report->is_brief ? text_file_name(path) : path);
}

// Prints the diffuse and specular light that the surface receives from one light.
static void print_received(const ExplainReport *report, const json_t *light, const Light *source,
                           bool shines, FILE *stream)
{
    explain_print_detail(report, light, "; intensity {intensity .6g}", stream);
    explain_print(report, light, "; diffuse {diffuse .6g}", stream);
    if (shines) {
        explain_print_detail(report, light, "; shine {shine .6g}", stream);
        explain_print(report, light, "; highlight {highlight .6g}", stream);
    }
    if (source->color.x < 1 || source->color.y < 1 || source->color.z < 1)
        explain_print(report, light, "; light color {color .6v}", stream);
    if (json_object_get(light, "tint") != NULL)
        explain_print(report, light, "; through glass of the color {tint .6v}", stream);
}

static void print_light(const ExplainReport *report, const ExplainedRay *ray, size_t index,
                        const json_t *light, FILE *stream)
{
    const ClrtLightState state = ray->lights[index].state;
    const bool is_sun = report->scene->lights.data[index].is_sun;
    const bool shines =
        report->scene->materials.data[ray->found.material].shader == SHADER_BLINN_PHONG;
    fprintf(stream, "    %s %-4zu ", is_sun ? "sun  " : "light", index + 1);
    switch (state) {
    case CLRT_LIGHT_BEHIND:
        fputs("does not reach it: the normal is turned away", stream);
        break;
    case CLRT_LIGHT_BEHIND_FACE:
        fputs("does not reach it: the face is turned away", stream);
        break;
    case CLRT_LIGHT_BLOCKED:
        fputs("is blocked by ", stream);
        explain_print_primitive(report, json_object_get(light, "blocker"), stream);
        explain_print_detail(report, light, ", {blocker_distance .6g} away", stream);
        if (!is_sun)
            explain_print_detail(report, light, "; the light is {distance .6g} away", stream);
        break;
    case CLRT_LIGHT_REACHES:
        fputs("reaches it", stream);
        if (!is_sun)
            explain_print_detail(report, light, " from {distance .6g} away", stream);
        break;
    }
    explain_print_detail(report, light, "; cosine {cosine .6g}", stream);
    if (state == CLRT_LIGHT_REACHES)
        print_received(report, light, &report->scene->lights.data[index], shines, stream);
    fputs("\n", stream);
}

// The points of an area light, counted by state, and the sums of their light.
typedef struct {
    size_t counts[CLRT_LIGHT_BEHIND_FACE + 1]; // by ClrtLightState
    size_t first_blocked;                      // index of the first blocked point
    double diffuse, highlight;
    bool is_tinted; // light passes through colored glass
} AreaSum;

static AreaSum sum_area(const json_t *lights, const ClrtExplainedLight *found, size_t first,
                        size_t count)
{
    AreaSum sum = {0};
    for (size_t i = first; i < first + count; i++) {
        const json_t *light = json_array_get(lights, i);
        const ClrtLightState state = found[i].state;
        if (state == CLRT_LIGHT_BLOCKED && sum.counts[state] == 0)
            sum.first_blocked = i;
        sum.counts[state]++;
        if (state != CLRT_LIGHT_REACHES)
            continue;
        sum.diffuse += json_real_value(json_object_get(light, "diffuse"));
        sum.highlight += json_real_value(json_object_get(light, "highlight"));
        sum.is_tinted = sum.is_tinted || json_object_get(light, "tint") != NULL;
    }
    return sum;
}

// Prints one line for the lights `first` to `first` + `count` - 1, which are points of an area
// light.
static void print_area(const ExplainReport *report, const json_t *lights, const AreaSum *sum,
                       size_t first, size_t count, FILE *stream)
{
    const size_t reaching = sum->counts[CLRT_LIGHT_REACHES];
    const size_t blocked = sum->counts[CLRT_LIGHT_BLOCKED];
    const size_t away = count - reaching - blocked;
    const Vec3 color = report->scene->lights.data[first].color;
    fprintf(stream, "    lights %zu to %zu, an area: %zu of %zu points reach it", first + 1,
            first + count, reaching, count);
    if (blocked > 0) {
        fprintf(stream, "; %zu blocked%s by ", blocked, blocked > 1 ? ", the first" : "");
        explain_print_primitive(
            report, json_object_get(json_array_get(lights, sum->first_blocked), "blocker"), stream);
    }
    if (away > 0)
        fprintf(stream, "; from %zu it is turned away", away);
    json_t *sums = JSON(FIELD("diffuse", sum->diffuse), FIELD("highlight", sum->highlight),
                        FIELD("color", json_pack("[f, f, f]", color.x, color.y, color.z)));
    if (reaching > 0)
        explain_print(report, sums, "; diffuse {diffuse .6g}", stream);
    if (sum->highlight > 0)
        explain_print(report, sums, "; highlight {highlight .6g}", stream);
    if (reaching > 0 && (color.x < 1 || color.y < 1 || color.z < 1))
        explain_print(report, sums, "; light color {color .6v}", stream);
    json_decref(sums);
    fputs("\n", stream);
}

void explain_print_lights(const ExplainReport *report, const ExplainedRay *ray,
                          const json_t *lights, FILE *stream)
{
    const Scene *scene = report->scene;
    size_t area = 0;
    for (size_t i = 0; i < ray->found.light_count;) {
        while (area < scene->area_lights.count && scene->area_lights.data[area].first < i)
            area++;
        const AreaLight *source =
            area < scene->area_lights.count ? &scene->area_lights.data[area] : NULL;
        const bool is_area = source != NULL && source->first == i;
        const size_t count = is_area ? (size_t)source->area.cells * source->area.cells : 1;
        const AreaSum sum = sum_area(lights, ray->lights, i, count);
        if (is_area && !sum.is_tinted)
            print_area(report, lights, &sum, i, count, stream);
        for (size_t point = i; point < i + count && (!is_area || sum.is_tinted); point++)
            print_light(report, ray, point, json_array_get(lights, point), stream);
        i += count;
    }
}
