// SPDX-License-Identifier: MIT
// Tests the error and the cost of adaptive anti-aliasing, and that every form of the kernels draws
// the same picture.
#include "image/rendered.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <stdio.h>

#define SCENES CLRT_SOURCE_FOLDER "/scenes/"

static PictureRequest square(const char *scene, uint32_t side)
{
    PictureRequest request = picture_request(scene, 1);
    request.width = request.height = side;
    return request;
}

static PictureRequest adaptive(PictureRequest request, float contrast)
{
    request.contrast = contrast;
    return request;
}

static const char *const scenes[] = {SCENES "simple.scn", SCENES "reflections.scn",
                                     SCENES "blinn_phong.scn",
                                     CLRT_SOURCE_FOLDER "/tests/image/every_feature.scn"};
#define SCENE_COUNT (sizeof scenes / sizeof scenes[0])

TEST(every_form_threads_and_tree_refine_the_same)
{
    for (size_t scene = 0; scene < SCENE_COUNT; scene++) {
        PictureRequest usual = adaptive(square(scenes[scene], 97), 0.02f);
        usual.height = 61;
        rendered_expect_same_in_every_form(&usual);
    }
}

#define SIDE 240

// With this contrast, the error must be at most 1.1 times the error of a uniform picture with
// `side` x `side` samples per pixel. The refined picture must take at most 1 / `times` of the
// uniform picture's samples.
typedef struct {
    float contrast;
    uint32_t side, times;
} Saving;

// The reference is a grid that shares no samples with the compared pictures. The error of the
// reference changes the quotients of errors by at most 0.14. The largest quotient stays between
// 0.85 and 0.87.
static void expect_error_of_uniform(const char *scene, const Framebuffer *reference,
                                    const Saving *saving)
{
    const uint32_t side = saving->side;
    uint64_t samples;
    PictureRequest uniform = square(scene, SIDE), few = adaptive(uniform, saving->contrast);
    few.sample_count = &samples;
    uniform.samples = side;
    FREED_BY(framebuffer_free) Framebuffer plain = rendered(&uniform), refined = rendered(&few);
    const double allowed = rendered_error(&plain, reference);
    const double reached = rendered_error(&refined, reference);
    if (reached > 1.1 * allowed)
        fail_msg("%s: error %g, of %ux%u samples %g", scene, reached, side, side, allowed);
    if (saving->times * samples > (uint64_t)SIDE * SIDE * side * side)
        fail_msg("%s: %llu samples", scene, (unsigned long long)samples);
}

TEST(contrasts_of_10_and_3_percent_save_most_samples)
{
    static const Saving savings[] = {{0.1f, 4, 8}, {0.03f, 8, 25}};
    for (size_t scene = 0; scene < SCENE_COUNT; scene++) {
        PictureRequest many = square(scenes[scene], SIDE);
        many.samples = 16;
        FREED_BY(framebuffer_free) Framebuffer reference = rendered(&many);
        expect_error_of_uniform(scenes[scene], &reference, &savings[0]);
        expect_error_of_uniform(scenes[scene], &reference, &savings[1]);
    }
}

TEST(a_picture_of_one_color_takes_a_sample_a_pixel)
{
    uint64_t samples;
    PictureRequest request = adaptive(square(scenes[0], 30), 0.001f);
    request.max_level = 0;
    request.sample_count = &samples;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    assert_int_equal(samples, 900);
}

#define SPHERES 60 // spheres along a side of the wall

// Draws bright spheres on black. Neighbors are about three pixels apart.
TEST(thousands_of_spheres_smaller_than_pixels_are_all_seen)
{
    static const double radii[] = {0.4, 0.2, 0.1, 0.05, 0.02, 0.01};
    char path[TEMPORARY_PATH];
    FILE *stream = temporary_open(path);
    fprintf(stream, "background 0 0 0\ndefine it silhouette diffuse 1 1 1\nmaterial it\n"
                    "camera 0 -100 0 0 0 0 60\n");
    const double pixel = 2 * 100 * tan(acos(-1) / 6) / 181;
    double expected = 0, sum = 0;
    for (int y = 0; y < SPHERES; y++)
        for (int x = 0; x < SPHERES; x++) {
            const double radius = radii[(y * 7 + x) % 6];
            const double right = (3.013 * (x - 30) + 0.5) * pixel;
            const double up = (2.971 * (y - 30) + 1.5) * pixel;
            // Away from the picture's center, spheres appear as ellipses.
            expected += acos(-1) * pow(radius, 2) * hypot(1, hypot(right, up) / 100);
            fprintf(stream, "sphere %.9g 0 %.9g %.9g\n", right, up, radius * pixel);
        }
    temporary_close(stream);
    const PictureRequest request = adaptive(square(path, 181), 1);
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    int seen = 0;
    for (int y = 0; y < SPHERES; y++)
        for (int x = 0; x < SPHERES; x++) {
            const double column = 90.5 + 3.013 * (x - 30) + 0.5;
            const double row = 90.5 - 2.971 * (y - 30) - 1.5;
            double light = 0;
            for (int dy = -1; dy <= 1; dy++)
                for (int dx = -1; dx <= 1; dx++)
                    light += (double)picture.pixels[((int)row + dy) * 181 + (int)column + dx][0];
            seen += light > 0;
            sum += light;
        }
    assert_int_equal(seen, SPHERES * SPHERES);
    assert_true(fabs(sum / expected - 1) < 0.02);
    remove(path);
}
