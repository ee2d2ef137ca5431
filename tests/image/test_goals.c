// SPDX-License-Identifier: MIT
// Tests pictures with error goals. Every form of the kernels must draw the same picture. Also tests
// the largest goal and a picture of one color. tests/goals measures whether clrt meets the goals.
#include "image/rendered.h"
#include "unit/cmocka_all.h"

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

// clrt refines at least 24 random pixels of each stratum of unrefined pixels (ladder_strata.h), or
// all pixels of a smaller stratum, to check that centers are representative.
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
