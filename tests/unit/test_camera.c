// SPDX-License-Identifier: MIT
// Compares the axes of camera rays with the course's formulas.
#include "scene/camera.h"

#include "unit/cmocka_all.h"

static const Viewpoint ahead = {{4, 0, 0}, {0, 0, 0}, {0, 0, 1}, 90};
static const Normalization unmoved = {{0, 0, 0}, 1};

TEST(right_and_down_span_the_image_plane)
{
    const CameraData camera = camera_make(&ahead, &unmoved, 100, 1);
    assert_true(camera.eye[0] == 4 && camera.forward[0] == -1);
    // At 90 degrees, half the plane's height is 1, divided into 100 half steps.
    assert_true(camera.right_step[1] == 0.01f && camera.right_step[2] == 0);
    assert_true(camera.down_step[2] == -0.01f && camera.down_step[1] == 0);
}

TEST(samples_divide_the_step)
{
    const CameraData one = camera_make(&ahead, &unmoved, 64, 1);
    const CameraData four = camera_make(&ahead, &unmoved, 64, 4);
    assert_true(one.right_step[1] == 4 * four.right_step[1]);
}

TEST(the_eye_moves_with_the_frame_and_directions_do_not)
{
    const Normalization moved = {{2, 1, 0}, 0.5};
    const CameraData camera = camera_make(&ahead, &moved, 100, 1);
    assert_true(camera.eye[0] == 1 && camera.eye[1] == -0.5f);
    assert_true(camera.forward[0] == -1);
}

TEST(a_shift_moves_samples_by_parts_of_their_distance)
{
    CameraData camera = camera_make(&ahead, &unmoved, 100, 1);
    camera_shift(&camera, 0.5, -0.25);
    // Samples are two half steps apart.
    assert_float_equal(camera.forward[1], 0.01, 1e-9);
    assert_float_equal(camera.forward[2], 0.005, 1e-9);
    assert_true(camera.forward[0] == -1);
}
