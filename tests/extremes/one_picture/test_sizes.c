// SPDX-License-Identifier: MIT
// Pictures of one pixel, one row, and 3.2 billion bytes; and of many samples a pixel.
#include "support/check.h"
#include "support/picture.h"
#include "support/random.h"
#include "support/report.h"
#include "support/scene_text.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/varied_scene.h"

#include "oracle/oracle.h"

#include <string.h>

// Returns the oracle's sample at the center of a pixel.
static OracleSample sample_at(const OracleView *view, uint32_t x, uint32_t y)
{
    return oracle_sample(view, x + 0.5, y + 0.5);
}

static bool pixel_agrees(const Framebuffer *picture, const OracleView *view, uint32_t x, uint32_t y)
{
    const float *color = picture->pixels[(size_t)y * picture->width + x];
    const OracleSample sample = sample_at(view, x, y);
    const double expected[3] = {sample.color.x, sample.color.y, sample.color.z};
    bool agrees = true;
    for (int channel = 0; channel < 3; channel++)
        agrees = agrees && fabs((double)color[channel] - expected[channel]) <= 1.0 / 255;
    return agrees || oracle_explains(view, x, y, color) != EXPLAINED_NOT;
}

#define PROBES 100

// Compares probed pixels with the oracle's; all where there are no more.
static size_t count_wrong_probes(const Studio *studio, uint32_t width, uint32_t height)
{
    Error error = {0};
    Oracle oracle;
    Framebuffer picture;
    size_t wrong = 0;
    Random random = {58};
    PictureSettings settings = picture_settings();
    settings.render.width = width;
    settings.render.height = height;
    settings.render.tile_width = settings.render.tile_height = width > 1000 ? 512 : 32;
    Scene scene = varied_scene();
    require(oracle_make(&oracle, &scene, &error), &error);
    const OracleView view =
        oracle_view(&oracle, &scene.viewpoints.data[0], width, height, settings.render.max_level);
    picture_draw(&picture, studio, &scene, &settings);
    const size_t pixels = (size_t)width * height, probes = pixels < PROBES ? pixels : PROBES;
    for (size_t i = 0; i < probes; i++) {
        const bool all = pixels <= PROBES;
        const uint32_t x = all ? (uint32_t)(i % width) : random_below(&random, width);
        const uint32_t y = all ? (uint32_t)(i / width) : random_below(&random, height);
        wrong += !pixel_agrees(&picture, &view, x, y);
    }
    wrong += !pixel_agrees(&picture, &view, width - 1, height - 1);
    framebuffer_free(&picture);
    oracle_free(&oracle);
    scene_free(&scene);
    char details[48];
    snprintf(details, sizeof details, "size=%ux%u", width, height);
    return report_case("T-58", details, probes + 1, wrong);
}

static void pictures_of_any_size_show_the_right_pixels_t58(void **state)
{
    static const char *const refused[] = {
        "size 0 0\n",     "size 0 5\n",     "size 5 0\n",     "size -1 5\n",
        "size 65537 1\n", "size 1e3 nan\n", "size 2.5 2.5\n", NULL};
    size_t wrong = scene_text_report("T-58", "refused", refused);
    wrong += count_wrong_probes(*state, 1, 1);
    wrong += count_wrong_probes(*state, 1, 77);
    wrong += count_wrong_probes(*state, 77, 1);
    wrong += count_wrong_probes(*state, 65536, 1);
    if (tier() == 2)
        wrong += count_wrong_probes(*state, 16384, 16384);
    assert_int_equal(wrong, 0);
}

static size_t count_other_pixels(const Framebuffer *picture, const float color[3])
{
    size_t others = 0;
    for (size_t pixel = 0; pixel < (size_t)picture->width * picture->height; pixel++)
        others += memcmp(picture->pixels[pixel], color, sizeof picture->pixels[pixel]) != 0;
    return others;
}

static void samples_of_one_color_make_that_color_exactly_t59(void **state)
{
    static const float color[3] = {0.5f, 0.1f, 0.7f};
    size_t others = 0;
    PictureSettings settings = picture_settings();
    settings.render.width = settings.render.height = 16;
    for (uint32_t samples = 1; samples <= SAMPLES_MAX; samples *= 2) {
        char details[32];
        Error error = {0};
        Framebuffer picture;
        Scene scene;
        const Viewpoint viewpoint = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 60, 0};
        require(scene_init(&scene, &error) && array_push(&scene.viewpoints, viewpoint, &error),
                &error);
        scene.background = vec3((double)color[0], (double)color[1], (double)color[2]);
        settings.render.samples = samples;
        picture_draw(&picture, *state, &scene, &settings);
        snprintf(details, sizeof details, "samples=%u", samples * samples);
        others += report_case("T-59", details, 16 * 16, count_other_pixels(&picture, color));
        framebuffer_free(&picture);
        scene_free(&scene);
    }
    assert_int_equal(others, 0);
}

static double rms_difference(const Framebuffer *a, const Framebuffer *b)
{
    double sum = 0;
    const size_t pixels = (size_t)a->width * a->height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int channel = 0; channel < 3; channel++) {
            const double apart = (double)(a->pixels[pixel][channel] - b->pixels[pixel][channel]);
            sum += apart * apart;
        }
    return sqrt(sum / (3.0 * (double)pixels));
}

static void draw_sampled(Framebuffer *picture, const Studio *studio, uint32_t samples)
{
    PictureSettings settings = picture_settings();
    settings.render.width = settings.render.height = (uint32_t)tier_size(48, 128);
    settings.render.samples = samples;
    Scene scene = varied_scene();
    picture_draw(picture, studio, &scene, &settings);
    scene_free(&scene);
}

// From 1 to 1024 samples a pixel the error falls at least as the root of their number; the
// reference has 4096.
static void errors_fall_with_the_number_of_samples_t60(void **state)
{
    Framebuffer reference;
    size_t slow = 0;
    double first = 0;
    draw_sampled(&reference, *state, SAMPLES_MAX);
    for (uint32_t samples = 1; samples <= 32; samples *= 2) {
        char details[64];
        Framebuffer picture;
        draw_sampled(&picture, *state, samples);
        const double error = rms_difference(&picture, &reference);
        first = samples == 1 ? error : first;
        snprintf(details, sizeof details, "samples=%u rmse=%.3g", samples * samples, error);
        slow += report_case("T-60", details, (size_t)picture.width * picture.height,
                            !(error <= first / samples));
        framebuffer_free(&picture);
    }
    framebuffer_free(&reference);
    assert_int_equal(slow, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_of_any_size_show_the_right_pixels_t58),
        cmocka_unit_test(samples_of_one_color_make_that_color_exactly_t59),
        cmocka_unit_test(errors_fall_with_the_number_of_samples_t60),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
