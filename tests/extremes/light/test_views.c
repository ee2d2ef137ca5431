// SPDX-License-Identifier: MIT
// Lights of any number and intensity, and cameras of any angle at any place.
#include "support/check.h"
#include "support/judged_picture.h"
#include "support/random.h"
#include "support/report.h"
#include "support/scene_text.h"
#include "support/shapes.h"

static void add_light(Scene *scene, Vec3 position, double intensity)
{
    Error error = {0};
    const Light light = light_white(position, intensity);
    require(array_push(&scene->lights, light, &error), &error);
}

static void set_view(Scene *scene, Vec3 eye, Vec3 look_at, double fov)
{
    Error error = {0};
    const Viewpoint viewpoint = {eye, look_at, {0, 0, 1}, fov, 0};
    require(array_push(&scene->viewpoints, viewpoint, &error), &error);
}

// A glossy ball on a floor.
static Scene ball(void)
{
    Error error = {0};
    const Sphere sphere = {{0, 0, 1}, 1, 2};
    Scene scene = shape_scene(shape_plane(vec3(-3, -3, 0), vec3(6, 0, 0), vec3(0, 6, 0), 3));
    require(array_push(&scene.spheres, sphere, &error), &error);
    set_view(&scene, vec3(1, -6, 3), vec3(0, 0, 0.75), 40);
    return scene;
}

static size_t judge_intensity(const Studio *studio, double intensity, size_t lights)
{
    char details[64];
    Random random = {54};
    Scene scene = ball();
    const PictureSettings settings = picture_settings();
    for (size_t i = 0; i < lights; i++) {
        const Vec3 aside = random_in_cube(&random, 3);
        add_light(&scene, vec3(aside.x, aside.y, 6), intensity);
    }
    snprintf(details, sizeof details, "intensity=%g lights=%zu", intensity, lights);
    const size_t wrong = picture_report("T-54", details, studio, &scene, &settings);
    scene_free(&scene);
    return wrong;
}

// Without light all is ambient, to the bit.
static size_t count_brighter(const Studio *studio, double intensity)
{
    Framebuffer none, dim;
    Scene dark = ball(), lit = ball();
    const PictureSettings settings = picture_settings();
    add_light(&lit, vec3(1, -1, 6), intensity);
    picture_draw(&none, studio, &dark, &settings);
    picture_draw(&dim, studio, &lit, &settings);
    const size_t differences = picture_count_differences(&none, &dim);
    framebuffer_free(&none);
    framebuffer_free(&dim);
    scene_free(&dark);
    scene_free(&lit);
    return report_case("T-54", "intensity=0 is=ambient",
                       (size_t)settings.render.width * settings.render.height, differences);
}

static void lights_of_any_intensity_and_number_are_added_right_t54(void **state)
{
    static const char *const refused[] = {"light 0 0 1 -1\n",       "light 0 0 1 nan\n",
                                          "light 0 0 1 inf\n",      "light 0 0 nan 1\n",
                                          "\nlight 0 0 1 -1e-30\n", NULL};
    size_t wrong = scene_text_report("T-54", "refused", refused);
    wrong += count_brighter(*state, 0);
    wrong += judge_intensity(*state, 0, 1);
    wrong += judge_intensity(*state, 1e-30, 1);
    wrong += judge_intensity(*state, 1, 0);
    wrong += judge_intensity(*state, 1e30, 1);
    wrong += judge_intensity(*state, 1e30, 10);
    wrong += judge_intensity(*state, 1e-3, 1000);
    assert_int_equal(wrong, 0);
}

static void cameras_of_any_angle_see_what_is_there_t56(void **state)
{
    static const char *const refused[] = {"camera 0 0 0 1 0 0 0\n",    "camera 0 0 0 1 0 0 180\n",
                                          "camera 0 0 0 1 0 0 360\n",  "camera 0 0 0 1 0 0 -40\n",
                                          "camera 0 0 0 1 0 0 nan\n",  "camera 0 0 0 1 0 0 inf\n",
                                          "camera 0 0 0 nan 0 0 40\n", NULL};
    static const double angles[] = {1e-4, 1e-2, 1, 90, 170, 179.9, 179.999};
    size_t wrong = scene_text_report("T-56", "refused", refused);
    const PictureSettings settings = picture_settings();
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        char details[32];
        Scene scene = shape_scene(shape_sphere(24, vec3(0, 0, 0)));
        add_light(&scene, vec3(4, -8, 5), 1);
        // The narrowest see the outline of the globe, the widest its inside.
        const Vec3 eye = angles[i] < 100 ? vec3(0.3, -9, 0.4) : vec3(0.1, 0.2, 0.3);
        set_view(&scene, eye, angles[i] < 1 ? vec3(1.9, 0, 0.4) : vec3(0, 0, 0), angles[i]);
        snprintf(details, sizeof details, "fov=%g", angles[i]);
        wrong += picture_report("T-56", details, *state, &scene, &settings);
        scene_free(&scene);
    }
    assert_int_equal(wrong, 0);
}

static void cameras_may_stand_anywhere_t57(void **state)
{
    static const char *const refused[] = {"up 0 0 1\ncamera 0 0 0 0 0 5 40\n",
                                          "up 0 0 -1\ncamera 1 1 1 1 1 -3 40\n",
                                          "up 1 2 3\ncamera 0 0 0 2 4 6 40\n",
                                          "camera 1 2 3 1 2 3 40\n",
                                          "up 0 0 0\n",
                                          NULL};
    static const struct {
        const char *name;
        Vec3 eye, look_at;
    } views[] = {{"inside", {0.1, -0.2, 0.3}, {1, 1, 0.5}},
                 {"on_vertex", {1, 1, 1}, {0, 0.1, 0.2}},
                 {"on_face", {0.25, 1, 0.125}, {0, 0, 0}},
                 {"on_face_outward", {0.25, -1, 0.125}, {0, -5, 0.5}},
                 {"on_plane_beside", {1, -5, 0.25}, {0.2, 0, 0}},
                 {"along_edge", {1, -4, 1}, {1, 4, 1}},
                 {"in_plane_of_face", {0.5, -4, 1}, {0.5, 4, 1}}};
    size_t wrong = scene_text_report("T-57", "refused", refused);
    PictureSettings settings = picture_settings();
    // An odd number puts a row and a column of rays into planes and along edges.
    settings.render.width = settings.render.height = 63;
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        char details[32];
        Scene scene = shape_scene(shape_cube(1, 4));
        add_light(&scene, vec3(4, -8, 5), 1);
        add_light(&scene, vec3(0.2, 0.1, 0.15), 0.5);
        set_view(&scene, views[i].eye, views[i].look_at, 60);
        snprintf(details, sizeof details, "view=%s", views[i].name);
        wrong += picture_report("T-57", details, *state, &scene, &settings);
        scene_free(&scene);
    }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_of_any_intensity_and_number_are_added_right_t54),
        cmocka_unit_test(cameras_of_any_angle_see_what_is_there_t56),
        cmocka_unit_test(cameras_may_stand_anywhere_t57),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
