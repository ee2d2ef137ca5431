// SPDX-License-Identifier: MIT
// A request and a pixel -> the explanation of the pixel. It owns copies of all samples, rays and
// lights, so callers may read them in any order.
#include "library/drawing.h"

#include "session/explainer.h"

#include <stdlib.h>
#include <string.h>

struct ClrtExplanation {
    ARRAY(ExplainedSample) samples; // each owns its rays and lights
    float color[3];
    uint32_t light_count;
};

static void free_sample(ExplainedSample *sample)
{
    for (uint32_t level = 0; sample->rays != NULL && level < sample->ray_count; level++)
        free((ExplainedLight *)sample->rays[level].lights);
    free((ExplainedRay *)sample->rays);
}

void clrt_explanation_free(ClrtExplanation *explanation)
{
    if (explanation == NULL)
        return;
    for (size_t i = 0; i < explanation->samples.count; i++)
        free_sample(&explanation->samples.data[i]);
    free(explanation->samples.data);
    free(explanation);
}

// Copies the lights of a ray, because the explainer overwrites them in the next sample.
static bool keep_lights(ExplainedRay *ray, const ExplainedRay *traced, uint32_t count, Error *cause)
{
    *ray = *traced;
    ray->lights = NULL;
    if (traced->primitive == NOTHING || !traced->uses_lights)
        return true;
    ExplainedLight *lights = memory_raw(count, sizeof *lights, cause);
    if (lights != NULL && count > 0)
        memcpy(lights, traced->lights, count * sizeof *lights);
    ray->lights = lights;
    return lights != NULL;
}

static bool keep_sample(ClrtExplanation *explanation, const ExplainedSample *traced, Error *cause)
{
    ExplainedSample sample = *traced;
    ExplainedRay *rays = memory_zeroed(traced->ray_count, sizeof *rays, cause);
    sample.rays = rays;
    bool ok = rays != NULL;
    for (uint32_t level = 0; ok && level < traced->ray_count; level++)
        ok = keep_lights(&rays[level], &traced->rays[level], explanation->light_count, cause);
    ok = ok && array_push(&explanation->samples, sample, cause);
    if (!ok)
        free_sample(&sample);
    return ok;
}

static bool trace(ClrtExplanation *explanation, Drawing *drawing, const uint32_t pixel[2],
                  Error *cause)
{
    Explainer explainer;
    ExplainedSample sample;
    const RenderSettings *settings = &drawing->request.settings;
    if (!explainer_open(&explainer, &drawing->renderer->session, settings,
                        &drawing->request.viewpoint, cause))
        return false;
    bool ok = true;
    explanation->light_count = (uint32_t)drawing->scene->lights.count;
    for (uint32_t i = 0; ok && i < settings->samples * settings->samples; i++)
        ok = explainer_trace(&explainer, pixel, i, &sample, cause) &&
             keep_sample(explanation, &sample, cause);
    if (ok)
        explainer_mix(&explainer, explanation->color);
    explainer_close(&explainer);
    return ok;
}

static bool check_pixel(const Drawing *drawing, const uint32_t pixel[2], ClrtError *error)
{
    const RenderSettings *settings = &drawing->request.settings;
    if (goal_is_given(&drawing->request.goal) || settings->whole_width > 0)
        return check_fail(error, CLRT_ARGUMENT, "explanations take no goal and no crop");
    return (pixel[0] < settings->width && pixel[1] < settings->height) ||
           check_fail(error, CLRT_ARGUMENT, "pixel %u,%u is not inside the picture of %u x %u",
                      pixel[0], pixel[1], settings->width, settings->height);
}

ClrtExplanation *clrt_explain(ClrtRenderer *renderer, const ClrtScene *scene,
                              const ClrtPicture *picture, const uint32_t pixel[2], ClrtError *error)
{
    Error cause = {0};
    Drawing drawing = {.renderer = renderer, .handle = scene};
    if (!check_given(error, "the pixel", pixel) || !drawing_begin(&drawing, picture, error))
        return NULL;
    ClrtExplanation *explanation = NULL;
    bool ok = check_pixel(&drawing, pixel, error) && drawing_take_scene(&drawing, error);
    if (ok) {
        explanation = memory_zeroed(1, sizeof *explanation, &cause);
        ok = (explanation != NULL && trace(explanation, &drawing, pixel, &cause)) ||
             check_fail_for(error, CLRT_DEVICE, &cause);
    }
    drawing_end(&drawing);
    if (ok)
        return explanation;
    clrt_explanation_free(explanation);
    return NULL;
}

bool clrt_explanation_get_pixel(const ClrtExplanation *explanation, ClrtExplainedPixel *pixel,
                                ClrtError *error)
{
    ClrtExplainedPixel filled;
    if (!check_given(error, "the explanation", explanation) ||
        !check_struct(error, "the pixel", pixel, &filled, sizeof filled))
        return false;
    filled = (ClrtExplainedPixel){.sample_count = (uint32_t)explanation->samples.count};
    memcpy(filled.color, explanation->color, sizeof filled.color);
    fill_struct(pixel, &filled, sizeof filled);
    return true;
}

static const ExplainedSample *find_sample(const ClrtExplanation *explanation, uint32_t place,
                                          ClrtError *error)
{
    if (!check_given(error, "the explanation", explanation))
        return NULL;
    if (place < explanation->samples.count)
        return &explanation->samples.data[place];
    check_fail(error, CLRT_ARGUMENT, "there is no sample %u", place);
    return NULL;
}

bool clrt_explanation_get_sample(const ClrtExplanation *explanation, uint32_t place,
                                 ClrtExplainedSample *sample, ClrtError *error)
{
    ClrtExplainedSample filled;
    const ExplainedSample *found = find_sample(explanation, place, error);
    if (found == NULL || !check_struct(error, "the sample", sample, &filled, sizeof filled))
        return false;
    filled = (ClrtExplainedSample){.background_weight = found->background_weight,
                                   .ray_count = found->ray_count};
    for (int channel = 0; channel < 3; channel++)
        filled.color[channel] = found->steps[channel] * 0x1p-32;
    fill_struct(sample, &filled, sizeof filled);
    return true;
}

static const ExplainedRay *find_ray(const ClrtExplanation *explanation, const uint32_t place[2],
                                    ClrtError *error)
{
    const ExplainedSample *sample =
        check_given(error, "the place", place) ? find_sample(explanation, place[0], error) : NULL;
    if (sample == NULL)
        return NULL;
    if (place[1] < sample->ray_count)
        return &sample->rays[place[1]];
    check_fail(error, CLRT_ARGUMENT, "sample %u has no ray %u", place[0], place[1]);
    return NULL;
}

bool clrt_explanation_get_ray(const ClrtExplanation *explanation, const uint32_t place[2],
                              ClrtExplainedRay *ray, ClrtError *error)
{
    ClrtExplainedRay filled;
    const ExplainedRay *found = find_ray(explanation, place, error);
    if (found == NULL || !check_struct(error, "the ray", ray, &filled, sizeof filled))
        return false;
    filled =
        (ClrtExplainedRay){.weight = found->weight,
                           .primitive = found->primitive,
                           .material = found->material,
                           .distance = found->distance,
                           .distance_error = found->error,
                           .share = found->share,
                           .light_count = found->lights != NULL ? explanation->light_count : 0};
    copy_vector(filled.origin, found->origin);
    copy_vector(filled.direction, found->direction);
    copy_vector(filled.point, found->point);
    copy_vector(filled.normal, found->normal);
    copy_vector(filled.shaded, found->shaded);
    fill_struct(ray, &filled, sizeof filled);
    return true;
}

bool clrt_explanation_get_light(const ClrtExplanation *explanation, const uint32_t place[3],
                                ClrtExplainedLight *light, ClrtError *error)
{
    ClrtExplainedLight filled;
    const ExplainedRay *ray = find_ray(explanation, place, error);
    if (ray == NULL || !check_struct(error, "the light", light, &filled, sizeof filled))
        return false;
    if (ray->lights == NULL || place[2] >= explanation->light_count)
        return check_fail(error, CLRT_ARGUMENT, "ray %u has no light %u", place[1], place[2]);
    const ExplainedLight *found = &ray->lights[place[2]];
    filled =
        (ClrtExplainedLight){.state = (ClrtLightState)found->state,
                             .blocker = found->state == LIGHT_BLOCKED ? found->blocker : NOTHING,
                             .cosine = found->cosine,
                             .distance = found->distance,
                             .blocker_distance = found->blocker_distance,
                             .diffuse = found->diffuse,
                             .specular = found->specular};
    fill_struct(light, &filled, sizeof filled);
    return true;
}
