// SPDX-License-Identifier: MIT
// Runs the kernel explain_sample and converts its results to scene coordinates.
#include "session/explainer.h"

#include "device/buffer.h"
#include "scene/camera.h"

#include <stdlib.h>

// kernels/explain.cl, embedded at build time.
extern const char explain_source[];

static uint32_t level_room(const Explainer *explainer)
{
    const uint32_t levels = explainer->frame.max_level;
    return levels > 0 ? levels : 1;
}

static size_t level_values(const Explainer *explainer)
{
    return LEVEL_VALUES + (size_t)explainer->frame.light_count * LIGHT_VALUES;
}

static size_t level_words(const Explainer *explainer)
{
    return LEVEL_WORDS + (size_t)explainer->frame.light_count * LIGHT_WORDS;
}

static size_t scalar_size(const Explainer *explainer)
{
    return explainer->is_fp64 ? sizeof(double) : sizeof(float);
}

static bool make_room(Explainer *explainer, Error *error)
{
    const Device *device = explainer->renderer.kernel->device;
    const size_t levels = level_room(explainer), scalar = scalar_size(explainer);
    const size_t values = levels * level_values(explainer);
    const size_t words = levels * level_words(explainer);
    explainer->host_values = memory_raw(values, scalar, error);
    explainer->host_words = memory_raw(words, sizeof *explainer->host_words, error);
    return explainer->host_values != NULL && explainer->host_words != NULL &&
           device_buffer(device, values * scalar, &explainer->values, error) &&
           device_buffer(device, words * sizeof(uint32_t), &explainer->words, error) &&
           device_buffer(device, 4 * scalar, &explainer->result, error) &&
           device_buffer(device, sizeof(uint32_t), &explainer->count, error);
}

static const KernelEntry explain_entry = {"explain_sample", explain_source,  NULL,
                                          "nnbbbb",         .dimensions = 1, .group = 1};

bool explainer_open(Explainer *explainer, Session *session, const RenderSettings *settings,
                    const Viewpoint *viewpoint, Error *error)
{
    const RendererUse use = {.entry = &explain_entry, .is_general = true};
    const SessionScene *scene = &session->scene;
    *explainer = (Explainer){.scene = scene->scene,
                             .normalization = &scene->normalization,
                             .is_fp64 = session->choice.precision == PRECISION_FP64};
    if (!session_renderer(session, &use, settings, &explainer->renderer, error))
        return false;
    const CameraData camera =
        camera_make(viewpoint, &scene->normalization, render_whole_width(settings),
                    render_whole_height(settings), settings->samples);
    explainer->frame = renderer_frame(&explainer->renderer, &camera);
    if (make_room(explainer, error))
        return true;
    explainer_close(explainer);
    return false;
}

void explainer_close(Explainer *explainer)
{
    device_release(&explainer->values);
    device_release(&explainer->words);
    device_release(&explainer->result);
    device_release(&explainer->count);
    free(explainer->host_values);
    free(explainer->host_words);
    *explainer = (Explainer){0};
}

static double scalar_at(const Explainer *explainer, const void *values, size_t place)
{
    return explainer->is_fp64 ? ((const double *)values)[place]
                              : (double)((const float *)values)[place];
}

// The kernel's values for one ray or light.
typedef struct {
    const Explainer *explainer;
    size_t value, word; // first indices in host_values and host_words
} Notes;

static Notes notes_of(const Explainer *explainer, uint32_t level)
{
    return (Notes){explainer, level * level_values(explainer), level * level_words(explainer)};
}

static double number_at(const Notes *notes, size_t place)
{
    return scalar_at(notes->explainer, notes->explainer->host_values, notes->value + place);
}

static Vec3 vector_at(const Notes *notes, size_t place)
{
    return vec3(number_at(notes, place), number_at(notes, place + 1), number_at(notes, place + 2));
}

static uint32_t noted_word(const Notes *notes, size_t place)
{
    return notes->explainer->host_words[notes->word + place];
}

static double length_of(Vec3 v)
{
    const double extent = vec3_extent(v);
    const Vec3 unit = vec3_scale(v, extent > 0 ? 1 / extent : 0);
    return extent * sqrt(vec3_dot(unit, unit));
}

static void take_light(ClrtExplainedLight *light, const Notes *level, uint32_t index, Vec3 point)
{
    const Explainer *explainer = level->explainer;
    const Notes notes = {explainer, level->value + LEVEL_VALUES + (size_t)index * LIGHT_VALUES,
                         level->word + LEVEL_WORDS + (size_t)index * LIGHT_WORDS};
    const Light *source = &explainer->scene->lights.data[index];
    const double traced = source->is_sun ? SUN_DISTANCE / explainer->normalization->scale
                                         : length_of(vec3_sub(source->position, point));
    *light = (ClrtExplainedLight){.state = (ClrtLightState)noted_word(&notes, LIGHT_STATE),
                                  .blocker = NOTHING,
                                  .cosine = number_at(&notes, LIGHT_COSINE),
                                  .distance = source->is_sun ? (double)INFINITY : traced};
    if (light->state == CLRT_LIGHT_BLOCKED) {
        light->blocker = noted_word(&notes, LIGHT_BLOCKER);
        light->blocker_distance = fmax(number_at(&notes, LIGHT_BLOCKER_T), 0) * traced;
    }
    if (light->state == CLRT_LIGHT_REACHES) {
        light->diffuse = number_at(&notes, LIGHT_DIFFUSE);
        light->specular = number_at(&notes, LIGHT_SPECULAR);
    }
}

static void take_surface(ExplainedRay *ray, const Notes *notes, ClrtExplainedLight *lights)
{
    const Explainer *explainer = notes->explainer;
    ClrtExplainedRay *found = &ray->found;
    const Vec3 point = denormalize_point(explainer->normalization, vector_at(notes, LEVEL_POINT));
    found->material = noted_word(notes, LEVEL_MATERIAL);
    found->share = number_at(notes, LEVEL_SHARE);
    vec3_store_doubles(found->point, point);
    vec3_store_doubles(found->normal, vector_at(notes, LEVEL_NORMAL));
    vec3_store_doubles(found->shaded, vector_at(notes, LEVEL_SHADED));
    if (explainer->scene->materials.data[found->material].shader != SHADER_SILHOUETTE)
        found->light_count = explainer->frame.light_count;
    ray->diffuse = vector_at(notes, LEVEL_DIFFUSE);
    ray->lights = lights;
    for (uint32_t i = 0; i < found->light_count; i++)
        take_light(&lights[i], notes, i, point);
}

static void take_ray(const Explainer *explainer, ExplainedSample *sample, uint32_t level)
{
    const Notes notes = notes_of(explainer, level);
    const Vec3 origin = vector_at(&notes, LEVEL_ORIGIN);
    const Vec3 direction = vector_at(&notes, LEVEL_DIRECTION);
    const double unit = length_of(direction) / explainer->normalization->scale;
    ExplainedRay *ray = &sample->rays[level];
    ray->found = (ClrtExplainedRay){.weight = number_at(&notes, LEVEL_WEIGHT),
                                    .primitive = noted_word(&notes, LEVEL_PRIMITIVE)};
    vec3_store_doubles(ray->found.origin, denormalize_point(explainer->normalization, origin));
    vec3_store_doubles(ray->found.direction, vec3_normalize(direction));
    if (ray->found.primitive == NOTHING)
        return;
    ray->found.distance = number_at(&notes, LEVEL_T) * unit;
    ray->found.distance_error = number_at(&notes, LEVEL_ERROR) * unit;
    take_surface(ray, &notes, sample->lights + (size_t)level * explainer->frame.light_count);
}

// Reads the kernel's outputs. Fills sample->found and allocates the rays and lights.
static bool read_back(const Explainer *explainer, ExplainedSample *sample, Error *error)
{
    ClrtExplainedSample *found = &sample->found;
    double result[4]; // fits floats and doubles
    const Device *device = explainer->renderer.kernel->device;
    const size_t levels = level_room(explainer), scalar = scalar_size(explainer);
    if (!device_read(device, explainer->values, explainer->host_values,
                     levels * level_values(explainer) * scalar, error) ||
        !device_read(device, explainer->words, explainer->host_words,
                     levels * level_words(explainer) * sizeof(uint32_t), error) ||
        !device_read(device, explainer->result, result, 4 * scalar, error) ||
        !device_read(device, explainer->count, &found->ray_count, sizeof found->ray_count, error))
        return false;
    for (size_t i = 0; i < 3; i++)
        found->color[i] = scalar_at(explainer, result, i) * 0x1p-32;
    found->background_weight = scalar_at(explainer, result, 3);
    const size_t lights = (size_t)found->ray_count * explainer->frame.light_count;
    sample->rays = memory_zeroed(found->ray_count, sizeof *sample->rays, error);
    sample->lights = memory_raw(lights, sizeof *sample->lights, error);
    return sample->rays != NULL && sample->lights != NULL;
}

bool explainer_trace(Explainer *explainer, const uint32_t pixel[2], uint32_t index,
                     ExplainedSample *sample, Error *error)
{
    const uint32_t side = explainer->frame.samples;
    const cl_uint place[2] = {pixel[0] * side + index % side, pixel[1] * side + index / side};
    const Renderer *renderer = &explainer->renderer;
    const KernelRun run = {.queue = renderer->kernel->device->queue,
                           .frame = &explainer->frame,
                           .scene = renderer->scene->arrays,
                           .arguments = {&place[0], &place[1], &explainer->values,
                                         &explainer->words, &explainer->result, &explainer->count},
                           .items = {1, 1}};
    *sample = (ExplainedSample){0};
    if (!kernel_run(renderer->kernel, &run, error) || !read_back(explainer, sample, error)) {
        explained_sample_free(sample);
        return false;
    }
    for (uint32_t level = 0; level < sample->found.ray_count; level++)
        take_ray(explainer, sample, level);
    for (int channel = 0; channel < 3; channel++)
        explainer->sums[channel] = (index == 0 ? 0 : explainer->sums[channel]) +
                                   (uint64_t)(sample->found.color[channel] * 0x1p32);
    return true;
}

void explained_sample_free(ExplainedSample *sample)
{
    free(sample->rays);
    free(sample->lights);
    *sample = (ExplainedSample){0};
}

// Must match pixel_colors of kernels/render.cl.
void explainer_mix(const Explainer *explainer, float color[3])
{
    const uint64_t count = (uint64_t)explainer->frame.samples * explainer->frame.samples;
    for (int channel = 0; channel < 3; channel++) {
        const uint64_t mean = (explainer->sums[channel] + count / 2) / count;
        color[channel] =
            explainer->is_fp64 ? (float)((double)mean * 0x1p-32) : (float)mean * 0x1p-32f;
    }
}
