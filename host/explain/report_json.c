// SPDX-License-Identifier: MIT
// Primitive ids equal the values of the --aov channel "primitive", which count from 0.
#include "explain/report.h"

#include "image/json_file.h"

#define SCHEMA_VERSION 1

static json_t *vector_json(Vec3 v)
{
    return json_pack("[f, f, f]", v.x, v.y, v.z);
}

static json_t *color_json(const float color[3])
{
    return json_pack("[f, f, f]", (double)color[0], (double)color[1], (double)color[2]);
}

static json_t *primitive_json(const Scene *scene, uint32_t id)
{
    const PrimitiveName name = name_primitive(scene, id);
    return json_pack("{s:s, s:I, s:o, s:I}", "kind", name.is_sphere ? "sphere" : "triangle",
                     "number", (json_int_t)name.number, "file",
                     name.is_sphere ? json_null() : json_file_path(name.path), "id",
                     (json_int_t)id);
}

static json_t *light_json(const ExplainReport *report, const ExplainedRay *ray, size_t index,
                          const Material *material)
{
    const ExplainedLight *light = &ray->lights[index];
    static const char *const states[] = {"behind", "reaches", "blocked", "behind_face"};
    const bool blocked = light->state == LIGHT_BLOCKED;
    const Light *source = &report->scene->lights.data[index];
    return json_pack(
        "{s:s, s:f, s:f, s:o, s:o, s:f, s:f, s:f, s:f, s:o}", "state", states[light->state],
        "cosine", light->cosine, "distance", light->distance, "blocker",
        blocked ? primitive_json(report->scene, light->blocker) : json_null(), "blocker_distance",
        blocked ? json_real(light->blocker_distance) : json_null(), "intensity", source->intensity,
        "diffuse", light->diffuse * (double)material->kd, "shine", light->shine, "highlight",
        light->specular * (double)material->ks, "color", vector_json(source->color));
}

static json_t *lights_json(const ExplainReport *report, const ExplainedRay *ray)
{
    json_t *list = json_array();
    const Scene *scene = report->scene;
    for (size_t i = 0; ray->uses_lights && i < scene->lights.count; i++)
        json_array_append_new(list,
                              light_json(report, ray, i, &scene->materials.data[ray->material]));
    return list;
}

// The factors of the surface's color besides the lights. Shaders that lack highlights ignore the
// material's ks.
static json_t *factors_json(const Scene *scene, const Material *material)
{
    static const char *const shaders[] = {"silhouette", "matte", "blinn_phong"};
    return json_pack("{s:s, s:f, s:o, s:f, s:o, s:f, s:f}", "shader", shaders[material->shader],
                     "ambient", scene->ambient, "diffuse_color", color_json(material->diffuse),
                     "kd", (double)material->kd, "specular_color", color_json(material->specular),
                     "ks", (double)material->ks, "shininess", (double)material->shininess);
}

static json_t *hit_json(const ExplainReport *report, const ExplainedRay *ray)
{
    const Scene *scene = report->scene;
    if (ray->primitive == NOTHING)
        return json_null();
    const Material *material = &scene->materials.data[ray->material];
    return json_pack("{s:o, s:s, s:f, s:f, s:o, s:o, s:o, s:o, s:o, s:f, s:f}", "primitive",
                     primitive_json(scene, ray->primitive), "material",
                     name_material(scene, ray->material), "distance", ray->distance,
                     "distance_error", ray->error, "point", vector_json(ray->point), "normal",
                     vector_json(ray->normal), "lights", lights_json(report, ray), "factors",
                     factors_json(scene, material), "color", vector_json(ray->shaded), "share",
                     ray->share, "reflectivity", (double)material->reflectivity);
}

static json_t *ray_json(const ExplainReport *report, const ExplainedRay *ray, uint32_t level)
{
    return json_pack("{s:s, s:o, s:o, s:f, s:o}", "kind", level == 0 ? "camera" : "reflected",
                     "origin", vector_json(ray->origin), "direction", vector_json(ray->direction),
                     "weight", ray->weight, "hit", hit_json(report, ray));
}

static json_t *sample_json(const ExplainReport *report, const ExplainedSample *sample)
{
    const double step = 0x1p-32;
    json_t *rays = json_array();
    for (uint32_t level = 0; level < sample->ray_count; level++)
        json_array_append_new(rays, ray_json(report, &sample->rays[level], level));
    return json_pack("{s:o, s:f, s:[f, f, f]}", "rays", rays, "background_weight",
                     sample->background_weight, "color", sample->steps[0] * step,
                     sample->steps[1] * step, sample->steps[2] * step);
}

// Returns NULL if the device fails.
static json_t *samples_json(const ExplainReport *report, Explainer *explainer, Error *error)
{
    ExplainedSample sample;
    json_t *list = json_array();
    const uint32_t side = report->settings->samples;
    for (uint32_t i = 0; i < side * side; i++) {
        if (!explainer_trace(explainer, report->pixel, i, &sample, error)) {
            json_decref(list);
            return NULL;
        }
        json_array_append_new(list, sample_json(report, &sample));
    }
    return list;
}

json_t *explain_json(const ExplainReport *report, Explainer *explainer, Error *error)
{
    float color[3];
    unsigned char bytes[3];
    const RenderSettings *settings = report->settings;
    json_t *samples = samples_json(report, explainer, error);
    if (samples == NULL)
        return NULL;
    explainer_mix(explainer, color);
    encode_channels(color, 3, report->encoding, 1, bytes);
    return json_pack("{s:i, s:s, s:o, s:[I, I], s:[I, I], s:I, s:o, s:o, s:o, s:[i, i, i]}",
                     "schema", SCHEMA_VERSION, "version", CLRT_VERSION, "scene",
                     json_file_path(report->scene_path), "pixel", (json_int_t)report->pixel[0],
                     (json_int_t)report->pixel[1], "size", (json_int_t)settings->width,
                     (json_int_t)settings->height, "view", (json_int_t)report->view, "background",
                     vector_json(report->scene->background), "samples", samples, "color",
                     color_json(color), "bytes", bytes[0], bytes[1], bytes[2]);
}
