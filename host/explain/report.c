// SPDX-License-Identifier: MIT
// Describes each sample as JSON. The text has a paragraph for each ray, with a line for each light.
// The templates of this text refer to JSON fields by name. Primitive ids count from 0, as in the
// --aov channel "primitive".
#include "explain/report.h"

#include "base/print.h"
#include "image/json_file.h"

#include <assert.h>

// Brief reports omit rays whose weight is below this, because such rays hardly change an 8-bit
// color.
#define BRIEF_WEIGHT (1 / 255.0)

// Returns the name of a defined or imported material, or the number of a predefined material.
static const char *name_material(const Scene *scene, uint32_t material)
{
    static const char *const courses[] = {"0", "1", "2", "3"};
    for (size_t i = 0; i < scene->material_names.list.count; i++)
        if (scene->material_names.list.data[i]->material == material)
            return scene->material_names.list.data[i]->name;
    assert(material < sizeof courses / sizeof *courses);
    return courses[material];
}

static json_t *vector_json(const double v[3])
{
    return json_pack("[f, f, f]", v[0], v[1], v[2]);
}

static json_t *color_json(Vec3 color)
{
    return json_pack("[f, f, f]", color.x, color.y, color.z);
}

// Returns a sphere's number in the scene, or a triangle's mesh file and number in that file.
// Spheres have the first ids. The triangles follow, mesh by mesh.
static json_t *primitive_json(const Scene *scene, uint32_t id)
{
    if (id < scene->spheres.count)
        return JSON(FIELD("kind", "sphere"), FIELD("number", id + 1), FIELD("file", json_null()),
                    FIELD("id", id));
    size_t number = id - scene->spheres.count, object = 0;
    while (number >= scene->objects.data[object].mesh.triangle_count) {
        number -= scene->objects.data[object++].mesh.triangle_count;
        assert(object < scene->objects.count);
    }
    const MeshObject *found = &scene->objects.data[object];
    return JSON(FIELD("kind", "triangle"), FIELD("number", scene_number_in_file(found, number)),
                FIELD("file", scene->inputs.data[found->input]), FIELD("id", id));
}

static bool is_white(const double color[3])
{
    return color[0] == 1 && color[1] == 1 && color[2] == 1;
}

static json_t *light_json(const ExplainReport *report, const ExplainedRay *ray, size_t index)
{
    static const char *const states[] = {"behind", "reaches", "blocked", "behind_face"};
    const ClrtExplainedLight *light = &ray->lights[index];
    const Light *source = &report->scene->lights.data[index];
    const Material *material = &report->scene->materials.data[ray->found.material];
    const bool blocked = light->state == CLRT_LIGHT_BLOCKED;
    json_t *blocker = blocked ? primitive_json(report->scene, light->blocker) : json_null();
    return JSON(FIELD("state", states[light->state]), FIELD("cosine", light->cosine),
                FIELD("distance", light->distance), FIELD("blocker", blocker),
                FIELD("blocker_distance", blocked ? light->blocker_distance : (double)NAN),
                FIELD("intensity", source->intensity),
                FIELD("diffuse", light->diffuse * (double)material->kd),
                FIELD("shine", source->intensity > 0 ? light->specular / source->intensity : 0.0),
                FIELD("highlight", light->specular * (double)material->ks),
                FIELD("color", color_json(source->color)),
                FIELD_IF(!is_white(light->tint), "tint", vector_json(light->tint)));
}

static json_t *lights_json(const ExplainReport *report, const ExplainedRay *ray)
{
    json_t *list = json_array();
    for (size_t i = 0; i < ray->found.light_count; i++)
        json_array_append_new(list, light_json(report, ray, i));
    return list;
}

// Returns all factors of the surface's color except the lights. Includes the factors of highlights
// even if the shader has no highlights.
static json_t *factors_json(const Scene *scene, const Material *material, Vec3 diffuse)
{
    if (material->shader == SHADER_GLASS)
        return JSON(FIELD("shader", shader_names[material->shader]),
                    FIELD("diffuse_color", color_json(diffuse)),
                    FIELD("ior", (double)material->ior));
    return JSON(FIELD("shader", shader_names[material->shader]), FIELD("ambient", scene->ambient),
                FIELD("diffuse_color", color_json(diffuse)), FIELD("kd", (double)material->kd),
                FIELD("specular_color", color_json(vec3_of_floats(material->specular))),
                FIELD("ks", (double)material->ks), FIELD("shininess", (double)material->shininess));
}

static json_t *hit_json(const ExplainReport *report, const ExplainedRay *ray)
{
    const Scene *scene = report->scene;
    const ClrtExplainedRay *found = &ray->found;
    if (found->primitive == NOTHING)
        return json_null();
    const Material *material = &scene->materials.data[found->material];
    return JSON(FIELD("primitive", primitive_json(scene, found->primitive)),
                FIELD("material", name_material(scene, found->material)),
                FIELD("distance", found->distance), FIELD("distance_error", found->distance_error),
                FIELD("point", vector_json(found->point)),
                FIELD("normal", vector_json(found->normal)),
                FIELD("lights", lights_json(report, ray)),
                FIELD("factors", factors_json(scene, material, ray->diffuse)),
                FIELD("color", vector_json(found->shaded)), FIELD("share", found->share),
                FIELD("reflectivity", (double)material->reflectivity));
}

static json_t *sample_json(const ExplainReport *report, const ExplainedSample *sample)
{
    json_t *rays = json_array();
    for (uint32_t level = 0; level < sample->found.ray_count; level++) {
        const ClrtExplainedRay *ray = &sample->rays[level].found;
        const char *kind = ray->is_refracted ? "refracted" : "reflected";
        const bool adds_background = ray->primitive == NOTHING && ray->share > 0;
        json_t *json = JSON(
            FIELD("kind", level == 0 ? "camera" : kind), FIELD("origin", vector_json(ray->origin)),
            FIELD("direction", vector_json(ray->direction)), FIELD("weight", ray->weight),
            FIELD("hit", hit_json(report, &sample->rays[level])),
            FIELD_IF(ray->level != level, "level", ray->level),
            FIELD_IF(ray->is_cut, "is_cut", ray->is_cut),
            FIELD_IF(adds_background, "background_weight", ray->share),
            FIELD_IF(!is_white(ray->tint), "tint", vector_json(ray->tint)));
        json_array_append_new(rays, json);
    }
    return JSON(FIELD("rays", rays), FIELD("background_weight", sample->found.background_weight),
                FIELD("color", vector_json(sample->found.color)));
}

static void print_factors(const json_t *factors, Shader shader, FILE *stream)
{
    if (shader == SHADER_GLASS) {
        json_print(factors, "    glass      index {ior .6g}, color {diffuse_color .6v}\n", stream);
        return;
    }
    json_print(factors, "    factors    diffuse color {diffuse_color .6v}", stream);
    if (shader != SHADER_SILHOUETTE)
        json_print(factors, ", kd {kd .6g}; ambient {ambient .6g}", stream);
    if (shader == SHADER_BLINN_PHONG)
        json_print(factors,
                   "; specular color {specular_color .6v}, ks {ks .6g}, shininess {shininess .6g}",
                   stream);
    fputs("\n", stream);
}

static void print_hit(const ExplainReport *report, const ExplainedRay *ray, const json_t *hit,
                      FILE *stream)
{
    const Material *material = &report->scene->materials.data[ray->found.material];
    explain_print_primitive(report, json_object_get(hit, "primitive"), stream);
    explain_print(report, hit,
                  ", material {material}\n"
                  "    distance   {distance .9g}",
                  stream);
    explain_print_detail(report, hit, ", off by at most {distance_error .2g}", stream);
    explain_print(report, hit, "\n    point      {point .6v}, normal {normal .6v}\n", stream);
    explain_print_lights(report, ray, json_object_get(hit, "lights"), stream);
    if (!report->is_brief)
        print_factors(json_object_get(hit, "factors"), material->shader, stream);
    if (material->shader == SHADER_GLASS)
        return;
    explain_print(report, hit, "    color      {color .6v}", stream);
    json_print(hit, ", weight {share .6g} in the sample", stream);
    if (material->reflectivity > 0)
        json_print(hit, "; reflectivity {reflectivity .6g}", stream);
    fputs("\n", stream);
}

static void print_ray(const ExplainReport *report, const ExplainedRay *ray, const json_t *json,
                      FILE *stream)
{
    explain_print_detail(report, json, "    from       {origin .6v} along {direction .6v}\n",
                         stream);
    if (ray->found.primitive != NOTHING) {
        fputs("    meets      ", stream);
        print_hit(report, ray, json_object_get(json, "hit"), stream);
        return;
    }
    fputs(ray->found.is_cut ? "    is cut by the maximum level" : "    meets      nothing", stream);
    fputs(ray->found.share > 0 ? ", so it adds the background\n" : "\n", stream);
}

static void print_sample(const ExplainReport *report, const ExplainedSample *sample,
                         const json_t *json, FILE *stream)
{
    const double least = report->is_brief ? BRIEF_WEIGHT : 0;
    const json_t *rays = json_object_get(json, "rays");
    for (uint32_t level = 0; level < sample->found.ray_count; level++) {
        const json_t *ray = json_array_get(rays, level);
        if (sample->rays[level].found.weight < least)
            continue;
        if (level == 0)
            fputs("  the camera's ray\n", stream);
        else {
            json_print(ray, "  {kind} ray ", stream);
            fprintf(stream, "%u", level);
            json_print(ray, ", weight {weight .6g} in the sample", stream);
            if (json_object_get(ray, "level") != NULL)
                json_print(ray, ", level {level}", stream);
            if (json_object_get(ray, "tint") != NULL)
                explain_print(report, ray, ", through glass of the color {tint .6v}", stream);
            fputs("\n", stream);
        }
        print_ray(report, &sample->rays[level], ray, stream);
    }
    if (sample->found.background_weight > least) {
        json_t *background = JSON(FIELD("color", color_json(report->scene->background)));
        explain_print(report, background, "  the background {color .6v}", stream);
        json_print(json, ", weight {background_weight .6g} in the sample\n", stream);
        json_decref(background);
    }
    explain_print_detail(report, json, "  the sample's color {color .6v}\n", stream);
}

// Traces the samples and adds their JSON to `list`. Prints all samples or, in brief reports, only
// the first. If `stream` is NULL, prints nothing.
static bool explain_samples(const ExplainReport *report, Explainer *explainer, json_t *list,
                            FILE *stream, Error *error)
{
    ExplainedSample sample;
    const uint32_t count = report->settings->samples * report->settings->samples;
    for (uint32_t i = 0; i < count; i++) {
        if (!explainer_trace(explainer, report->pixel, i, &sample, error))
            return false;
        json_t *json = sample_json(report, &sample);
        const bool is_printed = stream != NULL && (i == 0 || !report->is_brief);
        if (is_printed && count > 1)
            fprintf(stream, "sample %u of %u\n", i + 1, count);
        if (is_printed)
            print_sample(report, &sample, json, stream);
        json_array_append_new(list, json);
        explained_sample_free(&sample);
    }
    return true;
}

// Returns the whole report, or NULL if the device fails. Prints the samples unless `stream` is
// NULL.
static json_t *report_json(const ExplainReport *report, Explainer *explainer, FILE *stream,
                           Error *error)
{
    float color[3];
    unsigned char bytes[3];
    const RenderSettings *settings = report->settings;
    json_t *samples = json_array();
    if (!explain_samples(report, explainer, samples, stream, error)) {
        json_decref(samples);
        return NULL;
    }
    explainer_mix(explainer, color);
    framebuffer_encode(color, 3, report->encoding, 1, bytes);
    return REPORT(1, FIELD("scene", report->scene_path),
                  FIELD("pixel", json_two(report->pixel[0], report->pixel[1])),
                  FIELD("size", json_two(settings->width, settings->height)),
                  FIELD("view", report->view),
                  FIELD("background", color_json(report->scene->background)),
                  FIELD("samples", samples), FIELD("color", color_json(vec3_of_floats(color))),
                  FIELD("bytes", json_pack("[i, i, i]", bytes[0], bytes[1], bytes[2])));
}

json_t *explain_json(const ExplainReport *report, Explainer *explainer, Error *error)
{
    return report_json(report, explainer, NULL, error);
}

bool explain_write_text(const ExplainReport *report, Explainer *explainer, FILE *stream,
                        Error *error)
{
    fprintf(stream, "pixel %u,%u of %u x %u", report->pixel[0], report->pixel[1],
            report->settings->width, report->settings->height);
    if (!report->is_brief)
        print_text(stream, ", view %u of %s", report->view, report->scene_path);
    fputs("\n", stream);
    json_t *json = report_json(report, explainer, stream, error);
    if (json != NULL)
        explain_print(report, json,
                      "the pixel's color {color .9v}, in 8 bits {bytes.0} {bytes.1} {bytes.2}\n",
                      stream);
    json_decref(json);
    return json != NULL;
}
