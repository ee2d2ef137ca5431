// SPDX-License-Identifier: MIT
// Scenes of hardly anything, drawn by every tree and program and judged by the host in fp64.
#include "support/check.h"
#include "support/picture.h"
#include "support/report.h"
#include "support/shapes.h"
#include "support/witness.h"

#define SIZE 64

// Colors are multiples of 1/8, which pictures keep exactly.
static uint32_t add_color(Scene *scene)
{
    Error error = {0};
    Material color = material_of_shader(SHADER_SILHOUETTE);
    color.diffuse[0] = (float)(scene->materials.count % 8) / 8;
    color.diffuse[1] = 0.125f;
    color.diffuse[2] = 0.875f;
    require(array_push(&scene->materials, color, &error), &error);
    return (uint32_t)scene->materials.count - 1;
}

static void add_sphere(Scene *scene, Vec3 center, double radius)
{
    Error error = {0};
    const Sphere sphere = {center, radius, add_color(scene)};
    require(array_push(&scene->spheres, sphere, &error), &error);
}

// Counter-clockwise as seen from the camera where front is true; seen from that side alone unless
// it is two-sided.
static void add_triangle(Scene *scene, Vec3 place, bool front, bool two_sided)
{
    const Vec3 a = vec3_add(place, vec3(-1, 0, -0.75)), b = vec3_add(place, vec3(1, 0.5, -1));
    const Vec3 c = vec3_add(place, vec3(0.25, -0.5, 1));
    shape_add(scene, front ? shape_triangle(a, b, c) : shape_triangle(a, c, b), add_color(scene));
    scene->objects.data[scene->objects.count - 1].two_sided = two_sided;
}

static void nothing(Scene *scene)
{
    (void)scene;
}

static void one_triangle(Scene *scene)
{
    add_triangle(scene, vec3(0, 0, 0), true, false);
}

static void one_triangle_from_behind(Scene *scene)
{
    add_triangle(scene, vec3(0, 0, 0), false, false);
}

static void one_two_sided_triangle_from_behind(Scene *scene)
{
    add_triangle(scene, vec3(0, 0, 0), false, true);
}

static void two_triangles(Scene *scene)
{
    one_triangle(scene);
    add_triangle(scene, vec3(0.5, 1, 0.25), true, true);
}

static void three_triangles(Scene *scene)
{
    two_triangles(scene);
    add_triangle(scene, vec3(-0.5, -1, -0.5), false, true);
}

static void one_sphere(Scene *scene)
{
    add_sphere(scene, vec3(0.25, 0, 0), 1);
}

static void three_spheres(Scene *scene)
{
    one_sphere(scene);
    add_sphere(scene, vec3(-0.75, 0.5, 0.5), 0.75);
    add_sphere(scene, vec3(0.5, -1, -0.75), 0.5);
}

static void eye_in_a_sphere(Scene *scene)
{
    one_sphere(scene);
    add_sphere(scene, vec3(0, 0, 0), 20);
}

static void sphere_through_triangles(Scene *scene)
{
    three_triangles(scene);
    add_sphere(scene, vec3(0.25, 0, -0.25), 0.75);
}

// covered: whether anything is to be seen.
static const struct {
    const char *name;
    void (*fill)(Scene *);
    bool covered;
} scenes[] = {
    {"empty", nothing, false},
    {"one_triangle", one_triangle, true},
    {"one_triangle_from_behind", one_triangle_from_behind, false},
    {"one_two_sided_triangle_from_behind", one_two_sided_triangle_from_behind, true},
    {"two_triangles", two_triangles, true},
    {"three_triangles", three_triangles, true},
    {"one_sphere", one_sphere, true},
    {"three_spheres", three_spheres, true},
    {"eye_in_a_sphere", eye_in_a_sphere, true},
    {"sphere_through_triangles", sphere_through_triangles, true},
};

#define SCENES (sizeof scenes / sizeof *scenes)

static Scene make_scene(size_t number)
{
    Error error = {0};
    Scene scene;
    const Viewpoint viewpoint = {{0.3, -6, 0.2}, {0, 0, 0}, {0, 0, 1}, 30, 0};
    require(scene_init(&scene, &error) && array_push(&scene.viewpoints, viewpoint, &error), &error);
    scene.background = vec3(0.5, 0.75, 0.25);
    scenes[number].fill(&scene);
    return scene;
}

static bool pixel_shows(const Framebuffer *picture, uint32_t x, uint32_t y, const Scene *scene,
                        const Witness *witness)
{
    const float background[3] = {0.5f, 0.75f, 0.25f};
    const float *expected = witness->material == NOTHING
                                ? background
                                : scene->materials.data[witness->material].diffuse;
    const float *color = picture->pixels[(size_t)y * picture->width + x];
    return color[0] == expected[0] && color[1] == expected[1] && color[2] == expected[2];
}

// How many clear pixels show something else than the witness says.
static size_t wrong_pixels(const Framebuffer *picture, const Scene *scene,
                           const PictureSettings *settings, bool covered)
{
    Stage stage;
    size_t wrong = 0, unclear = 0, seen = 0;
    const CameraData camera = picture_camera(scene, &settings->render);
    stage_make_as(&stage, scene, TREE_NONE, NODES_PAIR);
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++) {
            const Witness witness = witness_pixel(&stage.flat, &camera, SIZE, x, y);
            unclear += !witness.clear;
            seen += witness.material != NOTHING;
            wrong += witness.clear && !pixel_shows(picture, x, y, scene, &witness);
        }
    stage_free(&stage);
    assert_in_range(unclear, 0, 4);
    assert_in_range(seen, covered ? SIZE * SIZE / 20 : 0, covered ? SIZE * SIZE : 0);
    return wrong;
}

static size_t draw_and_judge(const Studio *studio, size_t number, const PictureSettings *settings)
{
    char details[96];
    Framebuffer picture;
    Scene scene = make_scene(number);
    const bool special = settings->render.specialization == SPECIALIZE_ALWAYS;
    picture_draw(&picture, studio, &scene, settings);
    snprintf(details, sizeof details, "scene=%s tree=%s program=%s", scenes[number].name,
             tree_names[settings->tree], special ? "special" : "general");
    const size_t wrong =
        report_case("T-17", details, SIZE * SIZE,
                    wrong_pixels(&picture, &scene, settings, scenes[number].covered));
    framebuffer_free(&picture);
    scene_free(&scene);
    return wrong;
}

static void scenes_of_few_primitives_show_what_exact_geometry_shows_t17(void **state)
{
    size_t wrong = 0;
    PictureSettings settings = picture_settings();
    settings.render.width = settings.render.height = SIZE;
    for (size_t number = 0; number < SCENES; number++)
        for (TreeKind tree = TREE_SAH; tree < TREE_KINDS; tree++) {
            settings.tree = tree;
            settings.render.specialization = SPECIALIZE_NEVER;
            wrong += draw_and_judge(*state, number, &settings);
            settings.render.specialization = SPECIALIZE_ALWAYS;
            wrong += draw_and_judge(*state, number, &settings);
        }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_of_few_primitives_show_what_exact_geometry_shows_t17),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
