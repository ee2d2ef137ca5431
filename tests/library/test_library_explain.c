// SPDX-License-Identifier: MIT
// Explanations of pixels agree with the picture and with its channels.
#include "library/faults.h"
#include "library/filled.h"
#include "library/renderer.h"

#include <math.h>

#define WIDTH   12
#define HEIGHT  10
#define PIXELS  (WIDTH * HEIGHT)
#define NOTHING UINT32_MAX

static ClrtScene *scene;
static float rgb[PIXELS][3];

SET_UP(make_scene)
{
    scene = filled_make();
    return scene == NULL;
}

TEAR_DOWN(free_scene)
{
    clrt_scene_free(scene);
    return 0;
}

static ClrtPicture request(uint32_t samples)
{
    return (ClrtPicture){
        .size = sizeof(ClrtPicture), .width = WIDTH, .height = HEIGHT, .samples = samples};
}

static ClrtExplanation *explain(const ClrtPicture *picture, uint32_t pixel)
{
    ClrtError error;
    const uint32_t place[2] = {pixel % WIDTH, pixel / WIDTH};
    ClrtExplanation *explanation = clrt_explain(renderer, scene, picture, place, &error);
    if (explanation == NULL)
        fail_msg("%s", error.text);
    return explanation;
}

TEST(an_explained_pixel_has_the_pictures_color)
{
    const ClrtPicture picture = request(2);
    assert_true(clrt_render(renderer, scene, &picture, rgb[0], NULL));
    for (uint32_t pixel = 0; pixel < PIXELS; pixel += 7) {
        ClrtExplainedPixel whole = {.size = sizeof whole};
        ClrtExplainedSample sample = {.size = sizeof sample};
        ClrtExplanation *explanation = explain(&picture, pixel);
        assert_true(clrt_explanation_get_pixel(explanation, &whole, NULL));
        assert_memory_equal(whole.color, rgb[pixel], sizeof whole.color);
        assert_int_equal(whole.sample_count, 4);
        double mean = 0;
        for (uint32_t i = 0; i < 4; i++) {
            assert_true(clrt_explanation_get_sample(explanation, i, &sample, NULL));
            assert_true(sample.ray_count > 0);
            mean += sample.color[1] / 4;
        }
        assert_true(fabs(mean - (double)whole.color[1]) < 1e-6);
        clrt_explanation_free(explanation);
    }
}

// Expects the first ray of the pixel to have these values of the channels.
static void expect_channels(const ClrtExplanation *explanation, uint32_t primitive,
                            const float position[3], float shadow)
{
    const uint32_t place[2] = {0, 0};
    uint32_t reached = 0;
    ClrtExplainedRay ray = {.size = sizeof ray};
    assert_true(clrt_explanation_get_ray(explanation, place, &ray, NULL));
    assert_int_equal(ray.primitive, primitive);
    for (uint32_t i = 0; i < ray.light_count; i++) {
        ClrtExplainedLight light = {.size = sizeof light};
        assert_true(clrt_explanation_get_light(explanation, (uint32_t[]){0, 0, i}, &light, NULL));
        reached += light.state == CLRT_LIGHT_REACHES;
        assert_int_equal(light.state == CLRT_LIGHT_BLOCKED, light.blocker != NOTHING);
        assert_int_equal(light.state == CLRT_LIGHT_REACHES, light.diffuse > 0);
        assert_true(light.distance > 0);
    }
    if (primitive == NOTHING)
        return;
    assert_int_equal(ray.light_count, 3);
    assert_true(fabsf((float)reached / 3 - shadow) < 1e-6f);
    for (int axis = 0; axis < 3; axis++)
        assert_true(fabs(ray.point[axis] - (double)position[axis]) < 1e-5);
}

TEST(first_rays_have_the_values_of_the_channels)
{
    static uint32_t primitives[PIXELS];
    static float positions[PIXELS][3], shadows[PIXELS];
    const ClrtChannel channels[] = {
        {"primitive", primitives}, {"position", positions}, {"shadow", shadows}};
    ClrtPicture picture = request(1);
    picture.channels = channels;
    picture.channel_count = 3;
    assert_true(clrt_render(renderer, scene, &picture, rgb[0], NULL));
    for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
        ClrtExplanation *explanation = explain(&picture, pixel);
        expect_channels(explanation, primitives[pixel], positions[pixel], shadows[pixel]);
        clrt_explanation_free(explanation);
    }
}

static bool explains(ClrtPicture picture, uint32_t x, ClrtError *error)
{
    return clrt_explain(renderer, scene, &picture, (uint32_t[]){x, 0}, error) != NULL;
}

TEST(requests_without_an_explanation_are_refused)
{
    ClrtPicture picture = request(1);
    REFUSES(explains(picture, WIDTH, &error), "pixel 12,0 is not inside");
    REFUSES(clrt_explain(renderer, scene, &picture, NULL, &error) != NULL, "the pixel is NULL");
    picture.crop_width = picture.crop_height = 1;
    REFUSES(explains(picture, 0, &error), "no goal and no crop");
    picture = request(0);
    picture.error = 0.5;
    REFUSES(explains(picture, 0, &error), "no goal and no crop");
    clrt_explanation_free(NULL);
}

TEST(parts_that_do_not_exist_are_refused)
{
    const ClrtPicture picture = request(1);
    ClrtExplanation *explanation = explain(&picture, 0);
    ClrtExplainedSample sample = {.size = sizeof sample};
    ClrtExplainedRay ray = {.size = sizeof ray};
    ClrtExplainedLight light = {.size = sizeof light};
    REFUSES(clrt_explanation_get_pixel(explanation, NULL, &error), "the pixel is NULL");
    REFUSES(clrt_explanation_get_sample(explanation, 1, &sample, &error), "no sample 1");
    REFUSES(clrt_explanation_get_ray(explanation, (uint32_t[]){0, 9}, &ray, &error), "no ray 9");
    REFUSES(clrt_explanation_get_light(explanation, (uint32_t[]){0, 0, 3}, &light, &error),
            "no light 3");
    REFUSES(clrt_explanation_get_ray(NULL, (uint32_t[]){0, 0}, &ray, &error),
            "the explanation is NULL");
    clrt_explanation_free(explanation);
}
