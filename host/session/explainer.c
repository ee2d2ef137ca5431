// SPDX-License-Identifier: MIT
// Runs the kernel explain_sample and converts its results to scene coordinates.
#include "session/explainer.h"

#include "device/buffer.h"
#include "scene/camera.h"

#include <stdlib.h>

// kernels/explain.cl, embedded at build time.
extern const char explain_source[];

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

// value_bytes and word_bytes return the sizes of the two arrays in bytes. Each array has a head and
// `records` records.
static size_t value_bytes(const Explainer *explainer, size_t records)
{
    return (HEAD_VALUES + records * level_values(explainer)) * scalar_size(explainer);
}

static size_t word_bytes(const Explainer *explainer, size_t records)
{
    return (HEAD_WORDS + records * level_words(explainer)) * sizeof(uint32_t);
}

static void free_room(Explainer *explainer)
{
    buffer_release(&explainer->values);
    buffer_release(&explainer->words);
    free(explainer->host_values);
    free(explainer->host_words);
    explainer->host_values = NULL;
    explainer->host_words = NULL;
}

// Makes room for the head, `room` records and a spare record.
static bool make_room(Explainer *explainer, uint32_t room, Error *error)
{
    const Device *device = explainer->renderer.kernel->device;
    const size_t values = value_bytes(explainer, (size_t)room + 1);
    const size_t words = word_bytes(explainer, (size_t)room + 1);
    explainer->room = room;
    explainer->host_values = memory_raw(values, 1, error);
    explainer->host_words = memory_raw(words, 1, error);
    return explainer->host_values != NULL && explainer->host_words != NULL &&
           buffer_make(device, NULL, values, &explainer->values, error) &&
           buffer_make(device, NULL, words, &explainer->words, error);
}

static const KernelEntry explain_entry = {"explain_sample", explain_source,  NULL,
                                          "nnnbb",          .dimensions = 1, .group = 1};

bool explainer_open(Explainer *explainer, Session *session, const RenderSettings *settings,
                    const Viewpoint *viewpoint, Error *error)
{
    const RendererUse use = {.entry = &explain_entry, .is_general = true};
    const SessionScene *scene = &session->scene;
    *explainer = (Explainer){.scene = scene->scene,
                             .normalization = &scene->normalization,
                             .is_fp64 = session->choice.precision == CLRT_FP64};
    if (!session_renderer(session, &use, settings, &explainer->renderer, error))
        return false;
    const CameraData camera =
        camera_make(viewpoint, &scene->normalization, render_whole_width(settings),
                    render_whole_height(settings), settings->samples);
    explainer->frame = renderer_frame(&explainer->renderer, &camera);
    if (make_room(explainer, explainer->frame.max_level, error))
        return true;
    explainer_close(explainer);
    return false;
}

void explainer_close(Explainer *explainer)
{
    free_room(explainer);
    *explainer = (Explainer){0};
}

static double scalar_at(const Explainer *explainer, const void *values, size_t place)
{
    return explainer->is_fp64 ? ((const double *)values)[place]
                              : (double)((const float *)values)[place];
}

// The position in the buffers of the kernel's values for one ray or light.
typedef struct {
    const Explainer *explainer;
    size_t value, word; // indices of the first ones in host_values and host_words
} Notes;

static Notes notes_of(const Explainer *explainer, uint32_t level)
{
    return (Notes){explainer, HEAD_VALUES + level * level_values(explainer),
                   HEAD_WORDS + level * level_words(explainer)};
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
                                  .distance = source->is_sun ? (double)INFINITY : traced,
                                  .tint = {1, 1, 1}};
    if (light->state == CLRT_LIGHT_BLOCKED) {
        light->blocker = noted_word(&notes, LIGHT_BLOCKER);
        light->blocker_distance = fmax(number_at(&notes, LIGHT_BLOCKER_T), 0) * traced;
    }
    if (light->state == CLRT_LIGHT_REACHES) {
        light->diffuse = number_at(&notes, LIGHT_DIFFUSE);
        light->specular = number_at(&notes, LIGHT_SPECULAR);
        vec3_store_doubles(light->tint, vector_at(&notes, LIGHT_TINT));
    }
}

static void take_surface(ExplainedRay *ray, const Notes *notes, ClrtExplainedLight *lights)
{
    const Explainer *explainer = notes->explainer;
    ClrtExplainedRay *found = &ray->found;
    const Vec3 point = denormalize_point(explainer->normalization, vector_at(notes, LEVEL_POINT));
    found->material = noted_word(notes, LEVEL_MATERIAL);
    vec3_store_doubles(found->point, point);
    vec3_store_doubles(found->normal, vector_at(notes, LEVEL_NORMAL));
    if (IS_SHADED(explainer->scene->materials.data[found->material].shader))
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
                                    .primitive = noted_word(&notes, LEVEL_PRIMITIVE),
                                    .share = number_at(&notes, LEVEL_SHARE),
                                    .level = noted_word(&notes, LEVEL_NUMBER),
                                    .is_refracted = noted_word(&notes, LEVEL_REFRACTED) != 0};
    ray->found.is_cut = ray->found.level >= explainer->frame.max_level;
    vec3_store_doubles(ray->found.shaded, vector_at(&notes, LEVEL_SHADED));
    vec3_store_doubles(ray->found.tint, vector_at(&notes, LEVEL_TINT));
    vec3_store_doubles(ray->found.origin, denormalize_point(explainer->normalization, origin));
    vec3_store_doubles(ray->found.direction, vec3_normalize(direction));
    if (ray->found.primitive == NOTHING)
        return;
    ray->found.distance = number_at(&notes, LEVEL_T) * unit;
    ray->found.distance_error = number_at(&notes, LEVEL_ERROR) * unit;
    take_surface(ray, &notes, sample->lights + (size_t)level * explainer->frame.light_count);
}

// Traces the sample at a place of the sample grid, and reads the number of the sample's rays.
static bool trace_records(Explainer *explainer, const cl_uint place[2], Error *error)
{
    const Renderer *renderer = &explainer->renderer;
    const Device *device = renderer->kernel->device;
    const KernelRun run = {.queue = device->queue,
                           .frame = &explainer->frame,
                           .scene = renderer->scene->arrays,
                           .arguments = {&place[0], &place[1], &explainer->room, &explainer->values,
                                         &explainer->words},
                           .items = {1, 1}};
    return kernel_run(renderer->kernel, &run, error) &&
           buffer_read(device, explainer->words, explainer->host_words, word_bytes(explainer, 0),
                       error);
}

// Traces a sample and reads its records. If the sample has more rays than the buffers have room
// for, makes larger buffers and traces the sample again.
static bool read_records(Explainer *explainer, const cl_uint place[2], Error *error)
{
    if (!trace_records(explainer, place, error))
        return false;
    const Device *device = explainer->renderer.kernel->device;
    const uint32_t count = explainer->host_words[HEAD_RAYS];
    if (count > explainer->room) {
        free_room(explainer);
        if (!make_room(explainer, count, error) || !trace_records(explainer, place, error))
            return false;
    }
    return buffer_read(device, explainer->values, explainer->host_values,
                       value_bytes(explainer, count), error) &&
           buffer_read(device, explainer->words, explainer->host_words,
                       word_bytes(explainer, count), error);
}

// Converts the records. Fills *sample and allocates its rays and lights.
static bool take_sample(const Explainer *explainer, ExplainedSample *sample, Error *error)
{
    ClrtExplainedSample *found = &sample->found;
    const Notes head = {explainer, 0, 0};
    found->ray_count = noted_word(&head, HEAD_RAYS);
    vec3_store_doubles(found->color, vec3_scale(vector_at(&head, HEAD_COLOR), 0x1p-32));
    found->background_weight = number_at(&head, HEAD_BACKGROUND);
    const size_t lights = (size_t)found->ray_count * explainer->frame.light_count;
    sample->rays = memory_zeroed(found->ray_count, sizeof *sample->rays, error);
    sample->lights = memory_raw(lights, sizeof *sample->lights, error);
    if (sample->rays == NULL || sample->lights == NULL)
        return false;
    for (uint32_t level = 0; level < found->ray_count; level++)
        take_ray(explainer, sample, level);
    return true;
}

bool explainer_trace(Explainer *explainer, const uint32_t pixel[2], uint32_t index,
                     ExplainedSample *sample, Error *error)
{
    const uint32_t side = explainer->frame.samples;
    const cl_uint place[2] = {pixel[0] * side + index % side, pixel[1] * side + index / side};
    *sample = (ExplainedSample){0};
    if (!read_records(explainer, place, error) || !take_sample(explainer, sample, error)) {
        explained_sample_free(sample);
        return false;
    }
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

// Must compute the same bits as pixel_colors of kernels/render.cl.
void explainer_mix(const Explainer *explainer, float color[3])
{
    const uint64_t count = (uint64_t)explainer->frame.samples * explainer->frame.samples;
    for (int channel = 0; channel < 3; channel++) {
        const uint64_t mean = (explainer->sums[channel] + count / 2) / count;
        color[channel] =
            explainer->is_fp64 ? (float)((double)mean * 0x1p-32) : (float)mean * 0x1p-32f;
    }
}
