// SPDX-License-Identifier: MIT
// Scaling the whole scene, with its camera and lights, does not change a bit of the picture.
#include "support/varied_scene.h"

#define LARGEST_EXPONENT 60

// Tier 0 draws only some exponents.
static bool is_wanted(int exponent)
{
    return tier() > 0 || abs(exponent) == LARGEST_EXPONENT || abs(exponent) == 8 || exponent == 0;
}

static void a_scene_of_any_size_gives_the_same_picture_bit_by_bit_t46(void **state)
{
    const PictureSettings settings = picture_settings(64);
    Framebuffer unscaled = varied_picture(*state, &settings);
    assert_int_equal(picture_count_faults(&unscaled), 0);
    for (int exponent = -LARGEST_EXPONENT; exponent <= LARGEST_EXPONENT; exponent++) {
        if (!is_wanted(exponent))
            continue;
        Scene scene = varied_scene();
        varied_scene_scale(&scene, exponent);
        outcome_report(
            picture_compare("T-46", &unscaled, picture_draw_once(*state, scene, &settings)), "k=%d",
            exponent);
    }
    framebuffer_free(&unscaled);
}

RUN_TESTS(picture_setup, picture_teardown,
          TEST(a_scene_of_any_size_gives_the_same_picture_bit_by_bit_t46))
