// SPDX-License-Identifier: MIT
// Pictures of one pixel, one row, and 3.2 billion bytes, and pictures with many samples per pixel.
#include "support/random.h"
#include "support/scene_text.h"
#include "support/varied_scene.h"

#include "image/comparison.h"

static bool pixel_agrees(const Framebuffer *picture, const OracleView *view, uint32_t x, uint32_t y)
{
    const float *color = picture->pixels[(size_t)y * picture->width + x];
    const Vec3 expected = oracle_sample(view, x + 0.5, y + 0.5).color;
    const Vec3 actual = {(double)color[0], (double)color[1], (double)color[2]};
    return vec3_extent(vec3_sub(actual, expected)) <= (double)COLOR_TOLERANCE ||
           oracle_explains(view, x, y, color) != EXPLAINED_NOT;
}

#define PROBES 100

// Compares random pixels with the oracle's, or all pixels if they are few, and the last pixel.
static void judge_size(const Studio *studio, uint32_t width, uint32_t height)
{
    Error error = {0};
    Oracle oracle;
    Random random = {58};
    PictureSettings settings = picture_settings(width);
    settings.render.height = height;
    settings.render.tile_width = settings.render.tile_height = width > 1000 ? 512 : 32;
    Scene scene = varied_scene();
    require(oracle_make(&oracle, &scene, &error), &error);
    const OracleView view =
        oracle_view(&oracle, &scene.viewpoints.data[0], width, height, settings.render.max_level);
    Framebuffer picture = picture_draw(studio, &scene, &settings);
    const size_t pixels = picture_pixels(&picture), probes = pixels < PROBES ? pixels : PROBES;
    size_t wrong = !pixel_agrees(&picture, &view, width - 1, height - 1);
    for (size_t i = 0; i < probes; i++) {
        const bool all = pixels <= PROBES;
        const uint32_t x = all ? (uint32_t)(i % width) : random_below(&random, width);
        const uint32_t y = all ? (uint32_t)(i / width) : random_below(&random, height);
        wrong += !pixel_agrees(&picture, &view, x, y);
    }
    framebuffer_free(&picture);
    oracle_free(&oracle);
    scene_free(&scene);
    outcome_report(outcome_of("T-58", probes + 1, wrong), "size=%ux%u", width, height);
}

static void pictures_of_any_size_show_the_right_pixels_t58(void **state)
{
    static const char *const refused[] = {
        "size 0 0\n",     "size 0 5\n",     "size 5 0\n",     "size -1 5\n",
        "size 131073 1\n", "size 1e3 nan\n", "size 2.5 2.5\n", NULL};
    outcome_report(scene_text_refusals("T-58", refused), "refused");
    judge_size(*state, 1, 1);
    judge_size(*state, 1, 77);
    judge_size(*state, 77, 1);
    judge_size(*state, 131072, 1);
    if (tier() == 2)
        judge_size(*state, 16384, 16384);
}

static void samples_of_one_color_make_that_color_exactly_t59(void **state)
{
    static const float color[3] = {0.5f, 0.1f, 0.7f};
    PictureSettings settings = picture_settings(16);
    uint32_t *samples = &settings.render.samples;
    for (*samples = 1; *samples <= SAMPLES_MAX; *samples *= 2) {
        Scene scene = scene_text_parse("camera 0 0 0 1 0 0 60\nbackground 0.5 %.17g %.17g\n",
                                       (double)color[1], (double)color[2]);
        Framebuffer picture = picture_draw_once(*state, scene, &settings);
        outcome_report(
            outcome_of("T-59", picture_pixels(&picture), picture_count_other(&picture, color)),
            "samples=%u", *samples * *samples);
        framebuffer_free(&picture);
    }
}

static double rms_difference(const Framebuffer *a, const Framebuffer *b)
{
    double sum = 0;
    const size_t values = 3 * picture_pixels(a);
    for (size_t i = 0; i < values; i++) {
        const double apart = (double)((*a->pixels)[i] - (*b->pixels)[i]);
        sum += apart * apart;
    }
    return sqrt(sum / (double)values);
}

// From 1 to 1024 samples, the error falls at least as the root of their number. The reference has
// 4096 samples.
static void errors_fall_with_the_number_of_samples_t60(void **state)
{
    double first = 0;
    PictureSettings settings = picture_settings((uint32_t)tier_size(48, 128));
    uint32_t *samples = &settings.render.samples;
    *samples = SAMPLES_MAX;
    Framebuffer reference = varied_picture(*state, &settings);
    for (*samples = 1; *samples <= 32; *samples *= 2) {
        Framebuffer picture = varied_picture(*state, &settings);
        const double error = rms_difference(&picture, &reference);
        first = *samples == 1 ? error : first;
        outcome_report(outcome_of("T-60", picture_pixels(&picture), !(error <= first / *samples)),
                       "samples=%u rmse=%.3g", *samples * *samples, error);
        framebuffer_free(&picture);
    }
    framebuffer_free(&reference);
}

RUN_TESTS(picture_setup, picture_teardown, EXTREME(pictures_of_any_size_show_the_right_pixels_t58),
          EXTREME(samples_of_one_color_make_that_color_exactly_t59),
          EXTREME(errors_fall_with_the_number_of_samples_t60))
