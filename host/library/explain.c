// SPDX-License-Identifier: MIT
// A request and a pixel -> the explanation of the pixel. The explanation owns all samples, rays and
// lights, so callers may read them in any order.
#include "library/drawing.h"

#include "session/explainer.h"
#include "session/level.h"

#include <stdlib.h>
#include <string.h>

struct ClrtExplanation {
    ARRAY(ExplainedSample) samples; // each owns its rays and lights
    float color[3];
};

void clrt_explanation_free(ClrtExplanation *explanation)
{
    if (explanation == NULL)
        return;
    for (size_t i = 0; i < explanation->samples.count; i++)
        explained_sample_free(&explanation->samples.data[i]);
    free(explanation->samples.memory);
    free(explanation);
}

static bool keep_sample(ClrtExplanation *explanation, ExplainedSample *sample, Error *cause)
{
    if (array_push(&explanation->samples, *sample, cause))
        return true;
    explained_sample_free(sample);
    return false;
}

static bool trace(ClrtExplanation *explanation, Drawing *drawing, const uint32_t pixel[2],
                  Error *cause)
{
    Explainer explainer;
    ExplainedSample sample;
    const RenderSettings *settings = &drawing->request.settings;
    if (!session_choose_level(&drawing->renderer->session, &drawing->request, cause) ||
        !explainer_open(&explainer, &drawing->renderer->session, settings,
                        &drawing->request.viewpoint, cause))
        return false;
    bool ok = true;
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
    if (goal_is_given(&drawing->wanted) || settings->whole_width > 0)
        return library_fail(error, CLRT_ARGUMENT, "explanations take no goal and no crop");
    return (pixel[0] < settings->width && pixel[1] < settings->height) ||
           library_fail(error, CLRT_ARGUMENT, "pixel %u,%u is not inside the picture of %u x %u",
                        pixel[0], pixel[1], settings->width, settings->height);
}

ClrtExplanation *clrt_explain(ClrtRenderer *renderer, const ClrtScene *scene,
                              const ClrtPicture *picture, const uint32_t pixel[2], ClrtError *error)
{
    Error cause = {0};
    Drawing drawing = {.renderer = renderer, .handle = scene};
    if (!argument_given(error, "the pixel", pixel) || !drawing_begin(&drawing, picture, error))
        return NULL;
    ClrtExplanation *explanation = NULL;
    bool ok = check_pixel(&drawing, pixel, error) && drawing_take_scene(&drawing, error);
    if (ok) {
        explanation = memory_zeroed(1, sizeof *explanation, &cause);
        ok = (explanation != NULL && trace(explanation, &drawing, pixel, &cause)) ||
             library_fail_for(error, CLRT_DEVICE, &cause);
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
    if (!argument_given(error, "the explanation", explanation))
        return false;
    ClrtExplainedPixel filled = {.sample_count = (uint32_t)explanation->samples.count};
    memcpy(filled.color, explanation->color, sizeof filled.color);
    return argument_fill(error, "the pixel", pixel, &filled, sizeof filled);
}

static const ExplainedSample *find_sample(const ClrtExplanation *explanation, uint32_t place,
                                          ClrtError *error)
{
    if (!argument_given(error, "the explanation", explanation))
        return NULL;
    if (place < explanation->samples.count)
        return &explanation->samples.data[place];
    library_fail(error, CLRT_ARGUMENT, "there is no sample %u", place);
    return NULL;
}

bool clrt_explanation_get_sample(const ClrtExplanation *explanation, uint32_t place,
                                 ClrtExplainedSample *sample, ClrtError *error)
{
    const ExplainedSample *found = find_sample(explanation, place, error);
    return found != NULL &&
           argument_fill(error, "the sample", sample, &found->found, sizeof found->found);
}

static const ExplainedRay *find_ray(const ClrtExplanation *explanation, const uint32_t place[2],
                                    ClrtError *error)
{
    const ExplainedSample *sample = argument_given(error, "the place", place)
                                        ? find_sample(explanation, place[0], error)
                                        : NULL;
    if (sample == NULL)
        return NULL;
    if (place[1] < sample->found.ray_count)
        return &sample->rays[place[1]];
    library_fail(error, CLRT_ARGUMENT, "sample %u has no ray %u", place[0], place[1]);
    return NULL;
}

bool clrt_explanation_get_ray(const ClrtExplanation *explanation, const uint32_t place[2],
                              ClrtExplainedRay *ray, ClrtError *error)
{
    const ExplainedRay *found = find_ray(explanation, place, error);
    return found != NULL &&
           argument_fill(error, "the ray", ray, &found->found, sizeof found->found);
}

bool clrt_explanation_get_light(const ClrtExplanation *explanation, const uint32_t place[3],
                                ClrtExplainedLight *light, ClrtError *error)
{
    const ExplainedRay *ray = find_ray(explanation, place, error);
    if (ray == NULL)
        return false;
    if (place[2] >= ray->found.light_count)
        return library_fail(error, CLRT_ARGUMENT, "ray %u has no light %u", place[1], place[2]);
    return argument_fill(error, "the light", light, &ray->lights[place[2]], sizeof *ray->lights);
}
