// SPDX-License-Identifier: MIT
// Writes a paragraph for each ray, with a line for each of its lights.
#include "explain/report.h"

#include <assert.h>
#include <string.h>

// Brief reports omit rays of less weight, because such rays hardly change a color of 8 bits.
#define BRIEF_WEIGHT (1 / 255.0)

// Ids number the spheres first, then the triangles, mesh after mesh.
PrimitiveName name_primitive(const Scene *scene, uint32_t id)
{
    if (id < scene->spheres.count)
        return (PrimitiveName){.is_sphere = true, .number = (size_t)id + 1};
    size_t number = id - scene->spheres.count, object = 0;
    while (number >= scene->objects.data[object].mesh.triangle_count) {
        number -= scene->objects.data[object++].mesh.triangle_count;
        assert(object < scene->objects.count);
    }
    const MeshObject *found = &scene->objects.data[object];
    return (PrimitiveName){.number = number_in_file(found, number),
                           .path = scene->inputs.data[found->input]};
}

const char *name_material(const Scene *scene, uint32_t material)
{
    static const char *const courses[] = {"0", "1", "2", "3"};
    for (size_t i = 0; i < scene->material_names.list.count; i++)
        if (scene->material_names.list.data[i].material == material)
            return scene->material_names.list.data[i].name;
    assert(material < sizeof courses / sizeof *courses);
    return courses[material];
}

static int digits_of(const ExplainReport *report)
{
    return report->is_brief ? 3 : 6;
}

static void write_vector(const ExplainReport *report, Vec3 v, FILE *stream)
{
    const int digits = digits_of(report);
    fprintf(stream, "(%.*g, %.*g, %.*g)", digits, v.x, digits, v.y, digits, v.z);
}

static void write_primitive(const ExplainReport *report, uint32_t id, FILE *stream)
{
    const PrimitiveName name = name_primitive(report->scene, id);
    const char *slash = name.is_sphere || !report->is_brief ? NULL : strrchr(name.path, '/');
    if (name.is_sphere)
        fprintf(stream, "sphere %zu", name.number);
    else
        fprintf(stream, "triangle %zu of %s", name.number, slash == NULL ? name.path : slash + 1);
}

static void write_head(const ExplainReport *report, FILE *stream)
{
    const RenderSettings *settings = report->settings;
    fprintf(stream, "pixel %u,%u of %u x %u", report->pixel[0], report->pixel[1], settings->width,
            settings->height);
    if (!report->is_brief)
        fprintf(stream, ", view %u of %s", report->view, report->scene_path);
    fprintf(stream, "\n");
}

static Vec3 color_of(const float color[3])
{
    return vec3((double)color[0], (double)color[1], (double)color[2]);
}

// Writes what the surface receives from a light that reaches it.
static void write_received(const ExplainReport *report, const ExplainedLight *light,
                           const Light *source, const Material *material, FILE *stream)
{
    const int digits = digits_of(report);
    const bool shines = material->shader == SHADER_BLINN_PHONG;
    if (!report->is_brief)
        fprintf(stream, "; intensity %.6g", source->intensity);
    fprintf(stream, "; diffuse %.*g", digits, light->diffuse * (double)material->kd);
    if (shines && !report->is_brief)
        fprintf(stream, "; shine %.6g", light->shine);
    if (shines)
        fprintf(stream, "; highlight %.*g", digits, light->specular * (double)material->ks);
    if (source->color.x < 1 || source->color.y < 1 || source->color.z < 1) {
        fprintf(stream, "; light color ");
        write_vector(report, source->color, stream);
    }
}

static void write_light(const ExplainReport *report, const ExplainedLight *light, uint32_t number,
                        const Material *material, FILE *stream)
{
    fprintf(stream, "    light %-4u ", number);
    if (light->state == LIGHT_BEHIND)
        fprintf(stream, "does not reach it: the normal is turned away");
    if (light->state == LIGHT_BEHIND_FACE)
        fprintf(stream, "does not reach it: the face is turned away");
    if (light->state == LIGHT_BLOCKED) {
        fprintf(stream, "is blocked by ");
        write_primitive(report, light->blocker, stream);
        if (!report->is_brief)
            fprintf(stream, ", %.6g away; the light is %.6g away", light->blocker_distance,
                    light->distance);
    }
    if (light->state == LIGHT_SEEN)
        fprintf(stream, "reaches it");
    if (light->state == LIGHT_SEEN && !report->is_brief)
        fprintf(stream, " from %.6g away", light->distance);
    if (!report->is_brief)
        fprintf(stream, "; cosine %.6g", light->cosine);
    if (light->state == LIGHT_SEEN)
        write_received(report, light, &report->scene->lights.data[number - 1], material, stream);
    fprintf(stream, "\n");
}

// Writes the other factors of the surface's color.
static void write_factors(const ExplainReport *report, const Material *material, FILE *stream)
{
    fprintf(stream, "    factors    diffuse color ");
    write_vector(report, color_of(material->diffuse), stream);
    if (material->shader != SHADER_SILHOUETTE)
        fprintf(stream, ", kd %.6g; ambient %.6g", (double)material->kd, report->scene->ambient);
    if (material->shader == SHADER_BLINN_PHONG) {
        fprintf(stream, "; specular color ");
        write_vector(report, color_of(material->specular), stream);
        fprintf(stream, ", ks %.6g, shininess %.6g", (double)material->ks,
                (double)material->shininess);
    }
    fprintf(stream, "\n");
}

static void write_surface(const ExplainReport *report, const ExplainedRay *ray, FILE *stream)
{
    const Scene *scene = report->scene;
    const Material *material = &scene->materials.data[ray->material];
    fprintf(stream, "    meets      ");
    write_primitive(report, ray->primitive, stream);
    fprintf(stream, ", material %s\n    distance   %.*g", name_material(scene, ray->material),
            report->is_brief ? 3 : 9, ray->distance);
    if (!report->is_brief)
        fprintf(stream, ", off by at most %.2g", ray->error);
    fprintf(stream, "\n    point      ");
    write_vector(report, ray->point, stream);
    fprintf(stream, ", normal ");
    write_vector(report, ray->normal, stream);
    fprintf(stream, "\n");
    for (uint32_t i = 0; ray->uses_lights && i < scene->lights.count; i++)
        write_light(report, &ray->lights[i], i + 1, material, stream);
    if (!report->is_brief)
        write_factors(report, material, stream);
    fprintf(stream, "    color      ");
    write_vector(report, ray->shaded, stream);
    fprintf(stream, ", weight %.6g in the sample", ray->share);
    if (material->reflectivity > 0)
        fprintf(stream, "; reflectivity %.6g", (double)material->reflectivity);
    fprintf(stream, "\n");
}

static void write_ray(const ExplainReport *report, const ExplainedRay *ray, uint32_t level,
                      FILE *stream)
{
    if (level == 0)
        fprintf(stream, "  the camera's ray\n");
    else
        fprintf(stream, "  reflected ray %u, weight %.6g in the sample\n", level, ray->weight);
    if (!report->is_brief) {
        fprintf(stream, "    from       ");
        write_vector(report, ray->origin, stream);
        fprintf(stream, " along ");
        write_vector(report, ray->direction, stream);
        fprintf(stream, "\n");
    }
    if (ray->primitive == NOTHING)
        fprintf(stream, "    meets      nothing\n");
    else
        write_surface(report, ray, stream);
}

static void write_sample(const ExplainReport *report, const ExplainedSample *sample,
                         uint32_t number, FILE *stream)
{
    const double step = 0x1p-32;
    const uint32_t samples = report->settings->samples * report->settings->samples;
    if (samples > 1)
        fprintf(stream, "sample %u of %u\n", number + 1, samples);
    for (uint32_t level = 0; level < sample->ray_count; level++)
        if (!report->is_brief || sample->rays[level].weight >= BRIEF_WEIGHT)
            write_ray(report, &sample->rays[level], level, stream);
    if (sample->background_weight > (report->is_brief ? BRIEF_WEIGHT : 0)) {
        fprintf(stream, "  the background ");
        write_vector(report, report->scene->background, stream);
        fprintf(stream, ", weight %.6g in the sample\n", sample->background_weight);
    }
    if (report->is_brief)
        return;
    fprintf(stream, "  the sample's color ");
    write_vector(report,
                 vec3(sample->steps[0] * step, sample->steps[1] * step, sample->steps[2] * step),
                 stream);
    fprintf(stream, "\n");
}

static void write_color(const ExplainReport *report, const float color[3], FILE *stream)
{
    unsigned char bytes[3];
    encode_channels(color, 3, report->encoding, 1, bytes);
    const int digits = report->is_brief ? 3 : 9;
    fprintf(stream, "the pixel's color (%.*g, %.*g, %.*g), in 8 bits %u %u %u\n", digits,
            (double)color[0], digits, (double)color[1], digits, (double)color[2], bytes[0],
            bytes[1], bytes[2]);
}

bool explain_write_text(const ExplainReport *report, Explainer *explainer, FILE *stream,
                        Error *error)
{
    float color[3];
    ExplainedSample sample;
    const uint32_t side = report->settings->samples;
    write_head(report, stream);
    for (uint32_t i = 0; i < side * side; i++) {
        if (!explainer_trace(explainer, report->pixel, i, &sample, error))
            return false;
        if (i == 0 || !report->is_brief)
            write_sample(report, &sample, i, stream);
    }
    explainer_mix(explainer, color);
    write_color(report, color, stream);
    return true;
}
