// SPDX-License-Identifier: MIT
// Tests the normalized coordinate frame of scenes, the number of levels of rays that a scene needs,
// and the axes of camera rays.
#include "accel/triangles.h"
#include "scene/camera.h"
#include "scene/normalize.h"
#include "unit/parsed.h"
#include "unit/random.h"

#include <stdlib.h>

TEST(the_largest_side_of_the_triangles_comes_to_between_one_and_two)
{
    FREED_BY(scene_free) Scene scene = parsed("mesh cube.ply scale 1000 translate 5000 0 0");
    const Normalization frame = normalization_of(&scene);
    const Mesh *mesh = &scene.objects.data[0].mesh;
    double low = 9, high = -9;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const double *p = mesh->positions[i];
        const double x = normalize_point(&frame, vec3(p[0], p[1], p[2])).x;
        low = fmin(low, x);
        high = fmax(high, x);
    }
    assert_true(fabs(low + high) < 1e-12);
    assert_true(high - low >= 0.5 && high - low < 2);
    int exponent;
    assert_true(frexp(frame.scale, &exponent) == 0.5);
}

#define PLACES 300

// Map coordinates can be in the millions and have nine decimals.
TEST(places_of_many_digits_are_kept_to_the_last_bit)
{
    double positions[PLACES][3];
    uint32_t corners[PLACES / 3][3];
    uint64_t random = 63;
    Error error = {0};
    Scene scene = {0};
    for (uint32_t i = 0; i < 3 * PLACES; i++) {
        positions[i / 3][i % 3] = 1000000 + i % 3 * 5000 + random_unit(&random);
        corners[i / 9][i / 3 % 3] = i / 3;
    }
    const MeshObject object = {.mesh = {.positions = positions,
                                        .triangles = corners,
                                        .vertex_count = PLACES,
                                        .triangle_count = PLACES / 3}};
    assert_true(array_push(&scene.objects, object, &error));
    const Normalization frame = normalization_of(&scene);
    const long double center[3] = {frame.center.x, frame.center.y, frame.center.z};
    FREED_BY(triangles_free) Triangles triangles = {0};
    assert_true(triangles_make(&triangles, &scene, &frame, NULL, &error));
    for (int i = 0; i < 3 * PLACES; i++) {
        const long double place = (positions[i / 3][i % 3] - center[i % 3]) * frame.scale;
        const long double rounding = scalbnl(1, ilogbl(place) - 24) + 0x1p-52L * fabsl(place);
        assert_true(fabsl(triangles.points[i / 3][i % 3] - place) <= rounding);
    }
    free(scene.objects.memory);
}

TEST(spheres_frame_a_scene_only_without_triangles)
{
    FREED_BY(scene_free) Scene spheres = parsed("sphere 10 0 0 4");
    assert_true(normalization_of(&spheres).center.x == 10);
    assert_true(normalization_of(&spheres).scale == 0.125);
    FREED_BY(scene_free) Scene both = parsed("sphere 0 0 -1e9 1e9\nmesh cube.ply");
    assert_true(normalization_of(&both).scale > 0.5);
}

#define BALL   "camera 3 -6 3 0 0 0.5 30\nsphere 0 0 0.5 0.5\n"
#define GROUND "sphere 0 0 -1e7 1e7\n"

static Vec3 center_of_spheres(const char *text)
{
    FREED_BY(scene_free) Scene scene = parsed(text);
    return normalization_of(&scene).center;
}

TEST(huge_and_distant_spheres_leave_the_center_at_the_eyes)
{
    const Vec3 far = center_of_spheres(BALL "sphere 1e7 0 0 0.01\n");
    assert_true(far.x == 3 && far.y == -6 && far.z == 3);
    const Vec3 ground = center_of_spheres(BALL GROUND);
    assert_true(ground.x == 3 && ground.y == -6 && ground.z == 3);
    const Vec3 two = center_of_spheres(BALL GROUND "camera 5 -6 3 0 0 0.5 30\n");
    assert_true(two.x == 4 && two.y == -6 && two.z == 3);
    const Vec3 flat = center_of_spheres(GROUND "camera 3 -6 3e5 0 0 0.5 orthographic 2\n");
    assert_true(flat.z == 3e5);
}

TEST(the_center_of_other_spheres_is_the_center_of_their_box)
{
    assert_true(center_of_spheres(BALL "sphere 0 0 -1e4 1e4\n").z == -9999.5);
    // The camera looks along an axis, and the point that it looks at is only near its eye.
    assert_true(center_of_spheres("sphere 0 0 0 50\ncamera 99 0 0 98.999 0 0 30").x == 0);
    // One center cannot be near two cameras that are far apart.
    assert_true(center_of_spheres(BALL GROUND "camera 1e7 0 0 0 0 0 30\n").x == 0);
    // The box around the spheres sets the scale, so the coordinates of spheres far from the eye
    // stay small.
    assert_true(center_of_spheres(BALL "sphere 3e7 0 0 1\ncamera 3 -8e7 0 3 -7.9e7 0 9\n").y == 0);
}

TEST(an_empty_scene_keeps_its_coordinates)
{
    FREED_BY(scene_free) Scene scene = parsed("");
    const Normalization frame = normalization_of(&scene);
    assert_true(frame.scale == 1 && frame.center.x == 0);
}

TEST(lights_too_far_away_are_refused_by_number)
{
    Error error = {0};
    FREED_BY(scene_free) Scene scene = parsed("sphere 0 0 0 1\nlight 0 0 5 1\nlight 0 0 1e20 1");
    const Normalization frame = normalization_of(&scene);
    assert_false(normalization_check(&frame, &scene, &error));
    assert_non_null(strstr(error.text, "light 2"));
}

// Returns a scene with a sphere of each reflectivity.
static Scene scene_of(const float reflectivities[], size_t count)
{
    Scene scene = {0};
    Error error = {0};
    for (uint32_t i = 0; i < count; i++) {
        const Material material = {.reflectivity = reflectivities[i]};
        const Sphere sphere = {.radius = 1, .material = i};
        assert_true(array_push(&scene.materials, material, &error));
        assert_true(array_push(&scene.spheres, sphere, &error));
    }
    return scene;
}

TEST(the_bound_is_the_largest_weight_that_is_left)
{
    FREED_BY(scene_free) Scene scene = scene_of((const float[]){0.25f, 0.5f, 0}, 3);
    assert_true(truncation_bound(&scene, 0) == 1);
    assert_true(truncation_bound(&scene, 3) == 0.125);
}

TEST(the_level_is_the_first_within_the_bound)
{
    FREED_BY(scene_free) Scene scene = scene_of((const float[]){0.5f}, 1);
    for (uint32_t level = 0; level < 30; level++) {
        assert_int_equal(truncation_level(&scene, ldexp(1, -(int)level)), level);
        assert_int_equal(truncation_level(&scene, ldexp(0.99, -(int)level)), level + 1);
    }
}

TEST(without_mirrors_one_level_is_exact)
{
    FREED_BY(scene_free) Scene scene = scene_of((const float[]){0}, 1), empty = {0};
    assert_int_equal(truncation_level(&scene, 1e-30), 1);
    assert_int_equal(truncation_level(&empty, 1e-30), 1);
    assert_true(truncation_bound(&scene, 1) == 0);
}

TEST(perfect_mirrors_take_all_levels)
{
    FREED_BY(scene_free) Scene scene = scene_of((const float[]){1}, 1);
    assert_int_equal(truncation_level(&scene, 0.5), MAX_LEVEL_LIMIT);
    assert_true(truncation_bound(&scene, MAX_LEVEL_LIMIT) == 1);
}

TEST(materials_that_nothing_uses_do_not_count)
{
    Error error = {0};
    FREED_BY(scene_free) Scene scene = scene_of((const float[]){0.25f}, 1);
    assert_true(array_push(&scene.materials, (Material){.reflectivity = 1}, &error));
    assert_true(truncation_bound(&scene, 2) == 0.0625);
}

static const Viewpoint ahead = {.eye = {4, 0, 0}, .up = {0, 0, 1}, .fov_degrees = 90};
static const Normalization unmoved = {{0, 0, 0}, 1};

TEST(right_and_down_span_the_image_plane)
{
    const CameraData camera = camera_make(&ahead, &unmoved, 100, 100, 1);
    assert_true(camera.eye[0] == 4 && camera.forward[0] == -1);
    // At 90 degrees, half the image plane's height is 1, which is divided into 100 half steps.
    assert_true(camera.right_step[1] == 0.01f && camera.right_step[2] == 0);
    assert_true(camera.down_step[2] == -0.01f && camera.down_step[1] == 0);
}

TEST(samples_divide_the_step)
{
    const CameraData one = camera_make(&ahead, &unmoved, 64, 64, 1);
    const CameraData four = camera_make(&ahead, &unmoved, 64, 64, 4);
    assert_true(one.right_step[1] == 4 * four.right_step[1]);
}

// A width of 90 degrees needs a half height of 2 if the picture is twice as high as wide.
TEST(only_a_picture_narrower_than_the_width_widens)
{
    Viewpoint wide = {.eye = {4, 0, 0}, .up = {0, 0, 1}, .fov_degrees = 45, .width_degrees = 90};
    const CameraData narrow = camera_make(&wide, &unmoved, 100, 200, 1);
    assert_true(narrow.down_step[2] == -0.01f && narrow.right_step[1] == 0.01f);
    const CameraData broad = camera_make(&wide, &unmoved, 1000, 100, 1);
    wide.width_degrees = 0;
    const CameraData plain = camera_make(&wide, &unmoved, 100, 100, 1);
    assert_memory_equal(&broad, &plain, sizeof plain);
}

// The height is 6, so each of 300 rows has a height of 0.02. Half of it is the length of down_step,
// which normalization scales.
TEST(orthographic_pictures_have_their_height_in_scene_units)
{
    Viewpoint flat = {.eye = {4, 0, 0}, .up = {0, 0, 1}, .height = 6};
    const CameraData camera = camera_make(&flat, &unmoved, 100, 300, 1);
    assert_int_equal(camera.orthographic, 1);
    assert_true(camera.down_step[2] == -0.01f && camera.right_step[1] == 0.01f);
    const CameraData half = camera_make(&flat, &(Normalization){{0, 0, 0}, 0.5}, 100, 300, 1);
    assert_true(half.down_step[2] == -0.005f && half.forward[0] == -1);
    flat.width = 4;
    assert_true(camera_make(&flat, &unmoved, 100, 300, 1).down_step[2] == -0.02f);
    assert_true(camera_make(&flat, &unmoved, 300, 300, 1).down_step[2] == -0.01f);
}

TEST(an_orthographic_shift_moves_the_start_of_rays)
{
    const Viewpoint flat = {.eye = {4, 0, 0}, .up = {0, 0, 1}, .height = 2};
    CameraData camera = camera_make(&flat, &unmoved, 100, 100, 1);
    camera_shift(&camera, 1, -0.5);
    assert_true(camera.forward[0] == -1 && camera.forward[1] == 0 && camera.forward[2] == 0);
    assert_true(camera.eye[0] == 4 && camera.eye[1] == 0.02f && camera.eye[2] == 0.01f);
}

TEST(orthographic_heights_are_limited_by_the_scenes_size)
{
    FREED_BY(scene_free) Scene scene = parsed("sphere 0 0 0 1\ncamera 4 0 0 0 0 0 orthographic 2");
    const double heights[] = {1e-11, 1e6, 1e-13, 3e6};
    for (int i = 0; i < 4; i++) {
        Error error = {0};
        const Normalization normalization = normalization_of(&scene);
        scene.viewpoints.data[0].height = heights[i];
        assert_int_equal(normalization_check(&normalization, &scene, &error), i < 2);
    }
}

TEST(the_eye_moves_with_the_frame_and_directions_do_not)
{
    const Normalization moved = {{2, 1, 0}, 0.5};
    const CameraData camera = camera_make(&ahead, &moved, 100, 100, 1);
    assert_true(camera.eye[0] == 1 && camera.eye[1] == -0.5f);
    assert_true(camera.forward[0] == -1);
}

TEST(a_shift_moves_samples_by_parts_of_their_distance)
{
    CameraData camera = camera_make(&ahead, &unmoved, 100, 100, 1);
    camera_shift(&camera, 0.5, -0.25);
    // right_step and down_step are half the distance between samples, which is 0.02.
    assert_float_equal(camera.forward[1], 0.01, 1e-9);
    assert_float_equal(camera.forward[2], 0.005, 1e-9);
    assert_true(camera.forward[0] == -1);
}

// In cubes, the frame's center is (2.5, -3, 0). The cube at the scene's origin must stay even.
TEST(checkers_move_into_the_frame)
{
    const Normalization normalization = {{1.25, -1.5, 0}, 0.25};
    Material material = {.check_size = 0.5f}, plain = {.kd = 1};
    normalize_checker(&material, &normalization);
    normalize_checker(&plain, &normalization);
    assert_true(material.check_rate == 8);
    assert_true(material.check_shift[0] == 0.5f && fabsf(material.check_shift[1]) == 1);
    assert_true(material.check_shift[2] == 0 && plain.check_rate == 0);
}
