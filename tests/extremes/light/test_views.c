// SPDX-License-Identifier: MIT
// Lights of any number and intensity, and cameras of any angle at any place.
#include "support/picture.h"
#include "support/random.h"
#include "support/scene_text.h"
#include "support/shapes.h"

// Returns a glossy ball on a floor, with lights of one intensity at random places.
static Scene ball(double intensity, size_t lights)
{
    Error error = {0};
    Random random = {54};
    Scene scene = scene_text_parse("material 2\nsphere 0 0 1 1\ncamera 1 -6 3 0 0 0.75 40\n");
    shape_add(&scene, shape_plane(vec3(-3, -3, 0), vec3(6, 0, 0), vec3(0, 6, 0), 3), 1);
    for (size_t i = 0; i < lights; i++) {
        Vec3 place = random_in_cube(&random, 3);
        place.z = 6;
        require(array_push(&scene.lights, light_white(place, intensity), &error), &error);
    }
    return scene;
}

static void lights_of_any_intensity_and_number_are_added_right_t54(void **state)
{
    static const struct {
        double intensity;
        size_t lights;
    } cases[] = {{0, 1}, {1e-30, 1}, {1, 0}, {1e30, 1}, {1e30, 10}, {1e-3, 1000}};
    static const char *const refused[] = {"light 0 0 1 -1\n",       "light 0 0 1 nan\n",
                                          "light 0 0 1 inf\n",      "light 0 0 nan 1\n",
                                          "\nlight 0 0 1 -1e-30\n", NULL};
    const PictureSettings settings = picture_settings(64);
    outcome_report(scene_text_refusals("T-54", refused), "refused");
    Framebuffer dark = picture_draw_once(*state, ball(0, 0), &settings);
    outcome_report(picture_compare("T-54", &dark, picture_draw_once(*state, ball(0, 1), &settings)),
                   "intensity=0 is=ambient");
    framebuffer_free(&dark);
    for (size_t i = 0; i < COUNT(cases); i++)
        outcome_report(
            picture_judge("T-54", *state, ball(cases[i].intensity, cases[i].lights), &settings),
            "intensity=%g lights=%zu", cases[i].intensity, cases[i].lights);
}

static void cameras_of_any_angle_see_what_is_there_t56(void **state)
{
    static const char *const refused[] = {"camera 0 0 0 1 0 0 0\n",    "camera 0 0 0 1 0 0 180\n",
                                          "camera 0 0 0 1 0 0 360\n",  "camera 0 0 0 1 0 0 -40\n",
                                          "camera 0 0 0 1 0 0 nan\n",  "camera 0 0 0 1 0 0 inf\n",
                                          "camera 0 0 0 nan 0 0 40\n", NULL};
    // The narrowest angles contain the outline of the globe, the widest its inside.
    static const struct {
        double angle;
        const char *view;
    } cases[] = {{1e-4, "0.3 -9 0.4 1.9 0 0.4"}, {1e-2, "0.3 -9 0.4 1.9 0 0.4"},
                 {1, "0.3 -9 0.4 0 0 0"},        {90, "0.3 -9 0.4 0 0 0"},
                 {170, "0.1 0.2 0.3 0 0 0"},     {179.9, "0.1 0.2 0.3 0 0 0"},
                 {179.999, "0.1 0.2 0.3 0 0 0"}};
    const PictureSettings settings = picture_settings(64);
    outcome_report(scene_text_refusals("T-56", refused), "refused");
    for (size_t i = 0; i < COUNT(cases); i++) {
        Scene scene =
            scene_text_parse("light 4 -8 5 1\ncamera %s %.17g\n", cases[i].view, cases[i].angle);
        shape_add(&scene, shape_sphere(24, vec3(0, 0, 0)), 1);
        outcome_report(picture_judge("T-56", *state, scene, &settings), "fov=%g", cases[i].angle);
    }
}

static void cameras_may_stand_anywhere_t57(void **state)
{
    static const char *const refused[] = {"up 0 0 1\ncamera 0 0 0 0 0 5 40\n",
                                          "up 0 0 -1\ncamera 1 1 1 1 1 -3 40\n",
                                          "up 1 2 3\ncamera 0 0 0 2 4 6 40\n",
                                          "camera 1 2 3 1 2 3 40\n",
                                          "up 0 0 0\n",
                                          NULL};
    static const char *const views[][2] = {
        {"inside", "0.1 -0.2 0.3 1 1 0.5"},       {"on_vertex", "1 1 1 0 0.1 0.2"},
        {"on_face", "0.25 1 0.125 0 0 0"},        {"on_face_outward", "0.25 -1 0.125 0 -5 0.5"},
        {"on_plane_beside", "1 -5 0.25 0.2 0 0"}, {"along_edge", "1 -4 1 1 4 1"},
        {"in_plane_of_face", "0.5 -4 1 0.5 4 1"}};
    // An odd size puts a row and a column of rays into planes and along edges.
    const PictureSettings settings = picture_settings(63);
    outcome_report(scene_text_refusals("T-57", refused), "refused");
    for (size_t i = 0; i < COUNT(views); i++) {
        Scene scene =
            scene_text_parse("light 4 -8 5 1\nlight 0.2 0.1 0.15 0.5\ncamera %s 60\n", views[i][1]);
        shape_add(&scene, shape_cube(1, 4), 1);
        outcome_report(picture_judge("T-57", *state, scene, &settings), "view=%s", views[i][0]);
    }
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(lights_of_any_intensity_and_number_are_added_right_t54),
          EXTREME(cameras_of_any_angle_see_what_is_there_t56),
          EXTREME(cameras_may_stand_anywhere_t57))
