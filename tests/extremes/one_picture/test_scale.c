// SPDX-License-Identifier: MIT
// Scaling the whole scene, with its camera and lights, does not change a bit of the picture.
#include "support/varied_scene.h"

static void a_scene_of_any_size_gives_the_same_picture_bit_by_bit_t46(void **state)
{
    const PictureSettings settings = picture_settings(64);
    Framebuffer unscaled = varied_picture(*state, &settings);
    assert_int_equal(picture_count_faults(&unscaled), 0);
    for (int exponent = -60; exponent <= 60; exponent += tier() == 0 ? 15 : 1) {
        Scene scene = varied_scene();
        varied_scene_scale(&scene, exponent);
        outcome_report(
            picture_compare("T-46", &unscaled, picture_draw_once(*state, scene, &settings)), "k=%d",
            exponent);
    }
    framebuffer_free(&unscaled);
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(a_scene_of_any_size_gives_the_same_picture_bit_by_bit_t46))
