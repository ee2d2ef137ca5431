// SPDX-License-Identifier: MIT
// A scene scaled as a whole, with its camera and lights, is the same scene.
#include "support/check.h"
#include "support/picture.h"
#include "support/report.h"
#include "support/tier.h"
#include "support/varied_scene.h"

#define LARGEST_EXPONENT 60

// Tier 0 has a few of them.
static bool is_wanted(int exponent)
{
    return tier() > 0 || abs(exponent) == LARGEST_EXPONENT || abs(exponent) == 8 || exponent == 0;
}

static void draw_scaled(Framebuffer *picture, const Studio *studio, int exponent)
{
    const PictureSettings settings = picture_settings();
    Scene scene = varied_scene();
    varied_scene_scale(&scene, exponent);
    picture_draw(picture, studio, &scene, &settings);
    scene_free(&scene);
}

static void a_scene_of_any_size_gives_the_same_picture_bit_by_bit_t46(void **state)
{
    Framebuffer unscaled;
    size_t differences = 0;
    draw_scaled(&unscaled, *state, 0);
    assert_int_equal(picture_count_faults(&unscaled), 0);
    assert_in_range(picture_count_covered(&unscaled), 64 * 64 / 3, 64 * 64);
    for (int exponent = -LARGEST_EXPONENT; exponent <= LARGEST_EXPONENT; exponent++) {
        char details[32];
        Framebuffer scaled;
        if (!is_wanted(exponent))
            continue;
        draw_scaled(&scaled, *state, exponent);
        snprintf(details, sizeof details, "k=%d", exponent);
        differences += report_case("T-46", details, (size_t)scaled.width * scaled.height,
                                   picture_count_differences(&unscaled, &scaled));
        framebuffer_free(&scaled);
    }
    framebuffer_free(&unscaled);
    assert_int_equal(differences, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_of_any_size_gives_the_same_picture_bit_by_bit_t46),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
