// SPDX-License-Identifier: MIT
// Compares the axes of camera rays with the course's formulas.
#include "scene/camera.h"

#include "unit/cmocka_all.h"

static const Viewpoint ahead = {{4, 0, 0}, {0, 0, 0}, {0, 0, 1}, 90, 0};
static const Normalization unmoved = {{0, 0, 0}, 1};

static void right_and_down_span_the_image_plane(void **state)
{
    (void)state;
    const CameraData camera = camera_make(&ahead, &unmoved, 100, 100, 1);
    assert_true(camera.eye[0] == 4 && camera.forward[0] == -1);
    // At 90 degrees, half the plane's height is 1, divided into 100 half steps.
    assert_true(camera.right_step[1] == 0.01f && camera.right_step[2] == 0);
    assert_true(camera.down_step[2] == -0.01f && camera.down_step[1] == 0);
}

static void samples_divide_the_step(void **state)
{
    (void)state;
    const CameraData one = camera_make(&ahead, &unmoved, 64, 64, 1);
    const CameraData four = camera_make(&ahead, &unmoved, 64, 64, 4);
    assert_true(one.right_step[1] == 4 * four.right_step[1]);
}

// A width of 90 degrees needs a half height of 2 if the picture is twice as high as wide.
static void only_a_picture_narrower_than_the_width_widens(void **state)
{
    (void)state;
    Viewpoint wide = {{4, 0, 0}, {0, 0, 0}, {0, 0, 1}, 45, 90};
    const CameraData narrow = camera_make(&wide, &unmoved, 100, 200, 1);
    assert_true(narrow.down_step[2] == -0.01f && narrow.right_step[1] == 0.01f);
    const CameraData broad = camera_make(&wide, &unmoved, 1000, 100, 1);
    wide.width_degrees = 0;
    const CameraData plain = camera_make(&wide, &unmoved, 100, 100, 1);
    assert_memory_equal(&broad, &plain, sizeof plain);
}

static void the_eye_moves_with_the_frame_and_directions_do_not(void **state)
{
    (void)state;
    const Normalization moved = {{2, 1, 0}, 0.5};
    const CameraData camera = camera_make(&ahead, &moved, 100, 100, 1);
    assert_true(camera.eye[0] == 1 && camera.eye[1] == -0.5f);
    assert_true(camera.forward[0] == -1);
}

static void a_shift_moves_samples_by_parts_of_their_distance(void **state)
{
    (void)state;
    CameraData camera = camera_make(&ahead, &unmoved, 100, 100, 1);
    camera_shift(&camera, 0.5, -0.25);
    // Samples are two half steps apart.
    assert_float_equal(camera.forward[1], 0.01, 1e-9);
    assert_float_equal(camera.forward[2], 0.005, 1e-9);
    assert_true(camera.forward[0] == -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(right_and_down_span_the_image_plane),
        cmocka_unit_test(samples_divide_the_step),
        cmocka_unit_test(only_a_picture_narrower_than_the_width_widens),
        cmocka_unit_test(a_shift_moves_samples_by_parts_of_their_distance),
        cmocka_unit_test(the_eye_moves_with_the_frame_and_directions_do_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
