// SPDX-License-Identifier: MIT
// Tests pictures with error goals. Every form of the kernels must draw the same picture. Also tests
// the largest goal, a picture of one color, and parts that are not visible at any pixel's center.
// tests/goals measures whether clrt meets the goals.
#include "image/rendered.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#define SCENES CLRT_SOURCE_FOLDER "/scenes/"

static PictureRequest request_for(const char *scene, double goal)
{
    PictureRequest request = picture_request(scene, 1);
    request.width = 97;
    request.height = 61;
    request.error_goal = goal;
    return request;
}

TEST(every_form_threads_and_tree_refine_the_same)
{
    static const char *const scenes[] = {SCENES "reflections.scn", SCENES "blinn_phong.scn",
                                         CLRT_SOURCE_FOLDER "/tests/image/every_feature.scn"};
    for (size_t scene = 0; scene < sizeof scenes / sizeof scenes[0]; scene++) {
        const PictureRequest usual = request_for(scenes[scene], 0.003);
        rendered_expect_same_in_every_form(&usual);
    }
}

// Controls check that centers are representative. clrt refines at least 32 random pixels of each
// stratum (ladder_strata.h) as controls, or all pixels of a smaller stratum.
TEST(with_a_goal_of_any_error_only_controls_are_refined)
{
    uint64_t samples;
    PictureRequest request = request_for(SCENES "reflections.scn", 1);
    request.sample_count = &samples;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    request.error_goal = 0;
    FREED_BY(framebuffer_free) Framebuffer centers = rendered(&request);
    const size_t pixels = (size_t)picture.width * picture.height;
    size_t changed = 0;
    for (size_t i = 0; i < pixels; i++)
        changed += memcmp(picture.pixels[i], centers.pixels[i], sizeof picture.pixels[i]) != 0;
    assert_true(changed > 0);
    assert_true(samples > pixels && samples < 2 * pixels);
    assert_true(changed <= (samples - pixels) / ladder_samples[1]);
}

TEST(a_picture_of_one_color_keeps_it)
{
    char path[TEMPORARY_PATH];
    FILE *scene = temporary_open(path);
    fprintf(scene, "up 0 1 0\ncamera 0 0 0 0 0 1 60\nbackground 0.1 0.3 0.7\nsphere 0 0 -5 1\n");
    temporary_close(scene);
    const PictureRequest request = request_for(path, 0.001);
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    const size_t pixels = (size_t)picture.width * picture.height;
    for (size_t i = 0; i < pixels; i++)
        assert_memory_equal(picture.pixels[i], ((float[3]){0.1f, 0.3f, 0.7f}), 3 * sizeof(float));
    unlink(path);
}

// White spheres at corners of the pixels of request_for()'s picture. No pixel's center shows a
// sphere. If is_mirrored, the spheres are behind the eye, and a mirror fills the picture.
typedef struct {
    int count;
    double radius; // in pixels
    double goal;
    bool is_mirrored;
} Dots;

static void write_dots(FILE *scene, uint64_t seed, const Dots *dots)
{
    const double depth = 5, side = 2 * sqrt(1.0 / 3) / 61 * depth;
    uint64_t state = seed;
    fprintf(scene, "up 0 1 0\ncamera 0 0 0 0 0 -1 60\nbackground 0 0 0\n");
    if (dots->is_mirrored)
        fprintf(scene, "define mirror matte diffuse 0 0 0 reflectivity 1\nmaterial mirror\n"
                       "mesh " SCENES "plateau.ply scale 4 translate 0 0 -2\n");
    fprintf(scene, "define white silhouette diffuse 1 1 1\nmaterial white\n");
    for (int i = 0; i < dots->count; i++) {
        const double x = floor(95 * random_unit(&state)) - 46.5;
        const double y = floor(59 * random_unit(&state)) - 28.5;
        fprintf(scene, "sphere %.9g %.9g %g %.9g\n", x * side, y * side,
                dots->is_mirrored ? depth - 4 : -depth, dots->radius * side);
    }
}

// Returns the picture's error divided by the goal.
static double dots_error(uint64_t seed, const Dots *dots)
{
    char path[TEMPORARY_PATH];
    FILE *scene = temporary_open(path);
    write_dots(scene, seed, dots);
    temporary_close(scene);
    PictureRequest request = request_for(path, dots->goal);
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    request.error_goal = 0;
    FREED_BY(framebuffer_free) Framebuffer centers = rendered(&request);
    request.samples = 16;
    FREED_BY(framebuffer_free) Framebuffer reference = rendered(&request);
    for (size_t i = 0; i < (size_t)picture.width * picture.height; i++)
        assert_true(centers.pixels[i][0] == 0);
    assert_true(rendered_error(&centers, &reference) > 1.5 * dots->goal);
    unlink(path);
    return rendered_error(&picture, &reference) / dots->goal;
}

TEST(parts_that_no_center_sees_are_found)
{
    const Dots dots = {16, 0.3, 0.004, false};
    for (uint64_t seed = 1; seed <= 5; seed++)
        assert_true(dots_error(seed, &dots) < 1.1);
}

// Only random controls find these parts, so the test limits the rate of failures. The errors of 3
// of 200 such pictures exceed 1.1 times the goal. With a prior that ignored the reflectivity, 27
// would exceed it.
#define MIRRORED 40

TEST(parts_that_only_a_mirror_shows_are_missed_in_at_most_1_of_20_pictures)
{
    const Dots dots = {24, 0.45, 0.01, true};
    int above = 0;
    double worst = 0;
    for (uint64_t seed = 1; seed <= MIRRORED; seed++) {
        const double error = dots_error(seed, &dots);
        above += error > 1.1;
        worst = fmax(worst, error);
    }
    print_message("%d of %d above 1.1 E, worst %.2f E\n", above, MIRRORED, worst);
    assert_true(20 * above <= MIRRORED && worst < 1.5);
}
