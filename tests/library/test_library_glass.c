// SPDX-License-Identifier: MIT
// Tests the level of rays in scenes with glass. Rays that max_level cuts off change the colors of
// glass. Limits of truncation and error goals therefore select the level by the weights of cut
// rays.
#include "library/renderer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#define WIDTH  60
#define HEIGHT 50
#define PIXELS (WIDTH * HEIGHT)

static float rgb[3 * PIXELS];

static ClrtPicture request(void)
{
    return (ClrtPicture){.size = sizeof(ClrtPicture), .width = WIDTH, .height = HEIGHT};
}

static double rms_difference(const float *a, const float *b)
{
    double sum = 0;
    for (int i = 0; i < 3 * PIXELS; i++)
        sum += (double)(a[i] - b[i]) * (double)(a[i] - b[i]);
    return sqrt(sum / (3 * PIXELS));
}

TEST(the_weights_of_cut_rays_bound_the_error)
{
    static float deep[3 * PIXELS];
    static const int levels[] = {16, 2, 4, 8};
    double bounds[4];
    ClrtScene *glass = clrt_scene_load(program_file("tests/image/glass.scn"), NULL, NULL);
    for (int i = 0; i < 4; i++) {
        ClrtResult result = {.size = sizeof result};
        ClrtPicture picture = request();
        picture.max_level = levels[i];
        picture.result = &result;
        assert_true(clrt_render(renderer, glass, &picture, i == 0 ? deep : rgb, NULL));
        bounds[i] = result.truncation;
        if (i > 0)
            assert_true(rms_difference(deep, rgb) <= bounds[i] + bounds[0]);
    }
    assert_true(bounds[0] < bounds[3] && bounds[3] < bounds[2] && bounds[2] < bounds[1]);
    assert_true(bounds[0] < 0.01 && bounds[1] < 1);
    clrt_scene_free(glass);
}

static ClrtResult draw_file(ClrtRenderer *drawer, const char *path, ClrtPicture picture, float *to)
{
    ClrtError error;
    ClrtResult result = {.size = sizeof result};
    ClrtScene *loaded = clrt_scene_load(path, NULL, NULL);
    picture.result = &result;
    if (!clrt_render(drawer, loaded, &picture, to, &error))
        fail_msg("%s", error.text);
    clrt_scene_free(loaded);
    return result;
}

static ClrtResult draw_glass(ClrtRenderer *drawer, ClrtPicture picture)
{
    return draw_file(drawer, program_file("tests/image/glass.scn"), picture, rgb);
}

// The picture is so small that the level is measured in all its pixels.
TEST(a_truncation_selects_the_smallest_level)
{
    ClrtPicture picture = request(), fixed = request();
    picture.truncation = 0.02;
    const ClrtResult chosen = draw_glass(renderer, picture);
    assert_true(chosen.max_level > 3 && chosen.max_level < 16 && chosen.truncation <= 0.02);
    fixed.max_level = (int32_t)chosen.max_level - 1;
    assert_true(draw_glass(renderer, fixed).truncation > 0.02);
    picture.crop_width = picture.crop_height = 9;
    assert_int_equal(draw_glass(renderer, picture).max_level, chosen.max_level);
}

TEST(every_kernel_and_tile_selects_the_same_level)
{
    static const ClrtKernel kernels[] = {CLRT_KERNEL_PAIR, CLRT_KERNEL_WIDE};
    ClrtPicture picture = request();
    picture.truncation = 0.02;
    const ClrtResult usual = draw_glass(renderer, picture);
    picture.tile_width = picture.tile_height = 7;
    for (int i = 0; i < 2; i++) {
        const ClrtSettings settings = {.size = sizeof settings,
                                       .device = getenv("CLRT_DEVICE"),
                                       .kernel = kernels[i],
                                       .threads = 1};
        ClrtRenderer *other = clrt_renderer_create(&settings, NULL);
        const ClrtResult result = draw_glass(other, picture);
        assert_int_equal(result.max_level, usual.max_level);
        assert_true(result.truncation == usual.truncation);
        clrt_renderer_free(other);
    }
}

// With this goal, rays cut at max_level cause a larger part of the error than the sampling does.
TEST(an_error_includes_the_cut_rays_of_a_chosen_level)
{
    ClrtPicture picture = request();
    picture.error = 0.015;
    const ClrtResult result = draw_glass(renderer, picture);
    assert_true(!result.goal_missed && result.error_bound <= 0.015);
    assert_true(result.max_level < 9 && result.truncation > 0 && result.truncation < 0.0135);
    assert_true(result.truncation < result.error && result.error < result.error_bound);
}

// The middle of the picture shows nested balls. The coarse picture of 64 x 64 pixels misses them.
TEST(an_error_adds_levels_for_balls_between_coarse_pixels)
{
    static float picture_rgb[3 * 256 * 256];
    ClrtPicture picture = {.size = sizeof picture, .truncation = 0.002};
    char path[] = "/tmp/clrt-balls-XXXXXX.scn";
    FILE *stream = fdopen(mkstemps(path, 4), "w");
    assert_non_null(stream);
    fputs("size 256 256\ncamera 0 -9 0  0 0 0  orthographic 256\ndefine clear glass\n"
          "define air glass ior 0.6667\n",
          stream);
    for (int i = 0; i < 6; i++)
        fprintf(stream, "material %s\nsphere 0 0 0 %g\n", i % 2 == 0 ? "clear" : "air",
                2.7 - 0.2 * i);
    fclose(stream);
    assert_int_equal(draw_file(renderer, path, picture, picture_rgb).max_level, 3);
    picture.truncation = 0x1p-25; // of float files; too small for a coarse picture to measure
    assert_int_equal(draw_file(renderer, path, picture, picture_rgb).max_level, 16);
    picture.truncation = 0;
    picture.error = 0.01;
    const ClrtResult refined = draw_file(renderer, path, picture, picture_rgb);
    assert_true(refined.max_level > 3 && refined.max_level < 16 && !refined.goal_missed);
    unlink(path);
}
