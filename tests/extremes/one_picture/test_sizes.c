// SPDX-License-Identifier: MIT
// Tests pictures of one pixel, of one row and of 3.2 billion bytes, and pictures with many samples
// per pixel.
#include "support/random_points.h"
#include "support/varied_scene.h"
#include "unit/parsed.h"

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

// Compares the last pixel and PROBES random pixels with the pixels of the oracle. If the picture
// has at most PROBES pixels, compares all of them instead.
static void judge_size(const Studio *studio, uint32_t width, uint32_t height)
{
    Error error = {0};
    Oracle oracle;
    Random random = {58};
    PictureSettings settings = picture_settings(width);
    settings.render.height = height;
    settings.render.tile_width = settings.render.tile_height = width > 1000 ? 512 : 32;
    FREED_BY(scene_free) Scene scene = varied_scene();
    require(oracle_make(&oracle, &scene, &error), &error);
    const OracleView view =
        oracle_view(&oracle, &scene.viewpoints.data[0], width, height, settings.render.max_level);
    FREED_BY(framebuffer_free) Framebuffer picture = picture_draw(studio, &scene, &settings);
    const size_t pixels = picture_pixels(&picture), probes = pixels < PROBES ? pixels : PROBES;
    size_t wrong = !pixel_agrees(&picture, &view, width - 1, height - 1);
    for (size_t i = 0; i < probes; i++) {
        const bool all = pixels <= PROBES;
        const uint32_t x = all ? (uint32_t)(i % width) : random_below(&random, width);
        const uint32_t y = all ? (uint32_t)(i / width) : random_below(&random, height);
        wrong += !pixel_agrees(&picture, &view, x, y);
    }
    oracle_free(&oracle);
    outcome_report(outcome_of("T-58", probes + 1, wrong), "size=%ux%u", width, height);
}

EXTREME(pictures_of_any_size_show_the_right_pixels_t58)
{
    judge_size(*state, 1, 1);
    judge_size(*state, 1, 77);
    judge_size(*state, 77, 1);
    judge_size(*state, 131072, 1);
    if (tier() == 2)
        judge_size(*state, 16384, 16384);
}

EXTREME(samples_of_one_color_make_that_color_exactly_t59)
{
    static const float color[3] = {0.5f, 0.1f, 0.7f};
    PictureSettings settings = picture_settings(16);
    uint32_t *samples = &settings.render.samples;
    for (*samples = 1; *samples <= SAMPLES_MAX; *samples *= 2) {
        Scene scene = parsed_format("camera 0 0 0 1 0 0 60\nbackground 0.5 %.17g %.17g\n",
                                    (double)color[1], (double)color[2]);
        FREED_BY(framebuffer_free)
        Framebuffer picture = picture_draw_once(*state, scene, &settings);
        outcome_report(
            outcome_of("T-59", picture_pixels(&picture), picture_count_other(&picture, color)),
            "samples=%u", *samples * *samples);
    }
}

FIXTURES(picture_setup, picture_teardown)
