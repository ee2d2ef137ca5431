// SPDX-License-Identifier: MIT
// Compares pictures with pictures of the oracle. The lights vary in number and intensity. The
// cameras vary in field of view and position. Some vertex normals are zero or cancel out.
#include "support/picture.h"
#include "support/random_points.h"
#include "support/shapes.h"
#include "unit/parsed.h"

// Returns a glossy ball on a floor, with lights of one intensity at random places.
static Scene ball(double intensity, size_t lights)
{
    Error error = {0};
    Random random = {54};
    Scene scene = parsed_format("material 2\nsphere 0 0 1 1\ncamera 1 -6 3 0 0 0.75 40\n");
    shape_add(&scene, shape_plane(vec3(-3, -3, 0), vec3(6, 0, 0), vec3(0, 6, 0), 3), 1);
    for (size_t i = 0; i < lights; i++) {
        Vec3 place = random_in_cube(&random, 3);
        place.z = 6;
        require(array_push(&scene.lights, light_white(place, intensity), &error), &error);
    }
    return scene;
}

EXTREME(lights_of_any_intensity_and_number_are_added_right_t54)
{
    static const struct {
        double intensity;
        size_t lights;
    } cases[] = {{0, 1}, {1e-30, 1}, {1, 0}, {1e30, 1}, {1e30, 10}, {1e-3, 1000}};
    const PictureSettings settings = picture_settings(64);
    for (size_t i = 0; i < COUNT(cases); i++)
        outcome_report(
            picture_judge("T-54", *state, ball(cases[i].intensity, cases[i].lights), &settings),
            "intensity=%g lights=%zu", cases[i].intensity, cases[i].lights);
}

EXTREME(cameras_of_any_angle_agree_with_the_oracle_t56)
{
    // The narrowest views show the globe's outline, and the widest views show its inside.
    static const struct {
        double angle;
        const char *view;
    } cases[] = {{1e-4, "0.3 -9 0.4 1.9 0 0.4"}, {1e-2, "0.3 -9 0.4 1.9 0 0.4"},
                 {1, "0.3 -9 0.4 0 0 0"},        {90, "0.3 -9 0.4 0 0 0"},
                 {170, "0.1 0.2 0.3 0 0 0"},     {179.9, "0.1 0.2 0.3 0 0 0"},
                 {179.999, "0.1 0.2 0.3 0 0 0"}};
    const PictureSettings settings = picture_settings(64);
    for (size_t i = 0; i < COUNT(cases); i++) {
        Scene scene =
            parsed_format("light 4 -8 5 1\ncamera %s %.17g\n", cases[i].view, cases[i].angle);
        shape_add(&scene, shape_sphere(24, vec3(0, 0, 0)), 1);
        outcome_report(picture_judge("T-56", *state, scene, &settings), "fov=%g", cases[i].angle);
    }
}

EXTREME(cameras_may_stand_anywhere_t57)
{
    static const char *const views[][2] = {
        {"inside", "0.1 -0.2 0.3 1 1 0.5"},       {"on_vertex", "1 1 1 0 0.1 0.2"},
        {"on_face", "0.25 1 0.125 0 0 0"},        {"on_face_outward", "0.25 -1 0.125 0 -5 0.5"},
        {"on_plane_beside", "1 -5 0.25 0.2 0 0"}, {"along_edge", "1 -4 1 1 4 1"},
        {"in_plane_of_face", "0.5 -4 1 0.5 4 1"}};
    // The size is odd, so that the rays of the middle row and column can lie in planes and along
    // edges of the cube.
    const PictureSettings settings = picture_settings(63);
    for (size_t i = 0; i < COUNT(views); i++) {
        Scene scene =
            parsed_format("light 4 -8 5 1\nlight 0.2 0.1 0.15 0.5\ncamera %s 60\n", views[i][1]);
        shape_add(&scene, shape_cube(1, 4), 1);
        outcome_report(picture_judge("T-57", *state, scene, &settings), "view=%s", views[i][0]);
    }
}

// Returns a tilted rectangle, nearly a square, with the vertex normals (0, 0, z[i]). eye and light
// are positions as text.
static Scene square(const float z[4], const char *eye, const char *light)
{
    Scene scene = parsed_format("up 0 1 0.1\ncamera %s 0 0 0.125 40\nlight %s 1\n", eye, light);
    Mesh mesh = shape_plane(vec3(-1, -1, 0), vec3(2, 0, 0), vec3(0, 2, 0.25), 1);
    mesh.normals = require_memory(4, sizeof *mesh.normals);
    for (int i = 0; i < 4; i++)
        vec3_store(mesh.normals[i], vec3(0, 0, (double)z[i]));
    shape_add(&scene, mesh, 2);
    return scene;
}

EXTREME(normals_that_are_nothing_or_cancel_out_give_no_fault_t55)
{
    static const struct {
        const char *name, *eye, *light;
        float normals[4];
    } cases[] = {{"zero_normals", "0 -1 4", "1 1 3", {0, 0, 0, 0}},
                 {"some_zero", "0 -1 4", "1 1 3", {1, 0, 1, 0}},
                 {"opposite", "0 -1 4", "1 1 3", {1, -1, -1, 1}},
                 {"behind", "0 0 4.125", "0 0 -3.875", {-1, -1, -1, -1}},
                 {"light_opposite_eye", "0 0 4.125", "0 0 -3.875", {1, 1, 1, 1}},
                 {"light_at_eye", "0 0 4.125", "0 0 4.125", {1, 1, 1, 1}}};
    const PictureSettings settings = picture_settings(64);
    for (size_t i = 0; i < COUNT(cases); i++)
        outcome_report(picture_judge("T-55", *state,
                                     square(cases[i].normals, cases[i].eye, cases[i].light),
                                     &settings),
                       "case=%s", cases[i].name);
}

FIXTURES(picture_setup, picture_teardown)
