// SPDX-License-Identifier: MIT
// Shadows where they are hard to get right: on convex shapes of any size and place, in rooms with
// and without a door, under contacts, in grazing light, and of lights on and inside of things.
#include "support/check.h"
#include "support/judged_picture.h"
#include "support/report.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/varied_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void add_light(Scene *scene, Vec3 position, double intensity)
{
    Error error = {0};
    const Light light = light_white(position, intensity);
    require(array_push(&scene->lights, light, &error), &error);
}

static void add_view(Scene *scene, Vec3 eye, Vec3 look_at, double fov)
{
    Error error = {0};
    const Viewpoint viewpoint = {eye, look_at, {0.01, 0.02, 1}, fov, 0};
    require(array_push(&scene->viewpoints, viewpoint, &error), &error);
}

static void add_sphere(Scene *scene, Vec3 center, double radius)
{
    Error error = {0};
    const Sphere sphere = {center, radius, 1};
    require(array_push(&scene->spheres, sphere, &error), &error);
}

static PictureSettings shadow_settings(void)
{
    PictureSettings settings = picture_settings();
    settings.render.width = settings.render.height = (uint32_t)tier_size(48, 128);
    return settings;
}

// Only light makes a pixel other than black.
static void darken(Scene *scene)
{
    scene->ambient = 0;
    scene->background = vec3(0, 0, 0);
}

static void translate(Scene *scene, Vec3 by)
{
    for (size_t i = 0; i < scene->objects.count; i++) {
        Mesh *mesh = &scene->objects.data[i].mesh;
        for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
            mesh->positions[vertex][0] = shape_rounded(mesh->positions[vertex][0] + by.x);
            mesh->positions[vertex][1] = shape_rounded(mesh->positions[vertex][1] + by.y);
            mesh->positions[vertex][2] = shape_rounded(mesh->positions[vertex][2] + by.z);
        }
    }
    for (size_t i = 0; i < scene->lights.count; i++)
        scene->lights.data[i].position = vec3_add(scene->lights.data[i].position, by);
    scene->viewpoints.data[0].eye = vec3_add(scene->viewpoints.data[0].eye, by);
    scene->viewpoints.data[0].look_at = vec3_add(scene->viewpoints.data[0].look_at, by);
}

// A globe lit from beside the eye: all that is seen is lit.
static Scene lit_globe(void)
{
    Scene scene = shape_scene(shape_sphere(20, vec3(0, 0, 0)));
    darken(&scene);
    add_light(&scene, vec3(6, -20, 5), 1);
    add_view(&scene, vec3(5, -18, 4), vec3(0, 0, 0), 14);
    return scene;
}

static void a_convex_shape_casts_no_shadow_on_itself_t39(void **state)
{
    size_t wrong = 0;
    const PictureSettings settings = shadow_settings();
    const int step = tier() == 0 ? 10 : 2;
    for (int exponent = 0; exponent <= 17; exponent += tier() == 0 ? 17 : 1) {
        char details[32];
        Scene scene = lit_globe();
        translate(&scene, shape_center(exponent));
        snprintf(details, sizeof details, "translation=2^%d", exponent);
        wrong += picture_report("T-39", details, *state, &scene, &settings);
        scene_free(&scene);
    }
    for (int exponent = -20; exponent <= 20; exponent += step) {
        char details[32];
        Scene scene = lit_globe();
        varied_scene_scale(&scene, exponent);
        snprintf(details, sizeof details, "scale=2^%d", exponent);
        wrong += picture_report("T-39", details, *state, &scene, &settings);
        scene_free(&scene);
    }
    assert_int_equal(wrong, 0);
}

// A room of thin walls around the eye, the light outside; with_door leaves triangles out.
static Scene dark_room(bool with_door)
{
    Scene scene = shape_scene(shape_cube(2, 6));
    Mesh *mesh = &scene.objects.data[0].mesh;
    if (with_door)
        for (size_t i = 0; i + 160 < mesh->triangle_count; i++)
            memcpy(mesh->triangles[mesh->triangle_count - 1 - i],
                   mesh->triangles[mesh->triangle_count - 5 - i], sizeof *mesh->triangles);
    darken(&scene);
    add_light(&scene, vec3(3.1, 2.9, -1.3), 1);
    add_light(&scene, vec3(-5, 4, 2), 1);
    add_view(&scene, vec3(-0.5, -0.25, 0.2), vec3(0.3, 0.2, -1), 120);
    return scene;
}

static void light_enters_a_room_through_its_door_alone_t39(void **state)
{
    Framebuffer picture;
    PictureSettings settings = shadow_settings();
    settings.render.samples = 2;
    Scene closed = dark_room(false);
    picture_draw(&picture, *state, &closed, &settings);
    size_t lit = picture_count_covered(&picture) + (picture.pixels[0][0] > 0);
    lit = report_case("T-39", "room=closed", (size_t)picture.width * picture.height * 4, lit);
    framebuffer_free(&picture);
    scene_free(&closed);
    settings.render.samples = 1;
    Scene open = dark_room(true);
    lit += picture_report("T-39", "room=door", *state, &open, &settings);
    scene_free(&open);
    assert_int_equal(lit, 0);
}

// A closed shape with sharp edges inward and outward, and lights all around it.
static Scene lit_from_outside(Random *random, double distance)
{
    Scene scene = shape_scene(shape_bumpy(random, vec3(0, 0, 0)));
    darken(&scene);
    for (int i = 0; i < 32; i++)
        add_light(&scene, vec3_scale(vec3_normalize(random_in_cube(random, 1)), distance), 1);
    add_view(&scene, vec3(0, 0, 0), vec3(1, 0, 0), 40);
    return scene;
}

// A point of an edge, or one of its ends.
static Vec3 random_edge_point(const Mesh *mesh, Random *random, bool at_end)
{
    const uint32_t *corners = mesh->triangles[random_below(random, (uint32_t)mesh->triangle_count)];
    const double *from = mesh->positions[corners[0]], *to = mesh->positions[corners[1]];
    const Vec3 a = {from[0], from[1], from[2]}, b = {to[0], to[1], to[2]};
    const double along = at_end ? 0 : random_between(random, 0, 1);
    return vec3_add(a, vec3_scale(vec3_sub(b, a), along));
}

static size_t count_dark(const Framebuffer *picture)
{
    size_t dark = 0;
    for (size_t pixel = 0; pixel < (size_t)picture->width * picture->height; pixel++)
        dark += !(picture->pixels[pixel][0] > 0);
    return dark;
}

// Pictures from the middle around edges and vertices, from 40 degrees down to where neighboring
// pixels see the same rounded point.
static size_t light_that_enters(const Studio *studio, double distance, size_t *pixels)
{
    size_t lit = 0;
    Random random = {3939};
    PictureSettings settings = shadow_settings();
    Scene scene = lit_from_outside(&random, distance);
    for (size_t view = 0; view < tier_size(28, 280); view++) {
        Framebuffer picture;
        const Mesh *mesh = &scene.objects.data[0].mesh;
        scene.viewpoints.data[0].look_at = random_edge_point(mesh, &random, view % 4 == 0);
        scene.viewpoints.data[0].fov_degrees = 40 * pow(0.1, (double)(view % 7));
        picture_draw(&picture, studio, &scene, &settings);
        *pixels += (size_t)picture.width * picture.height;
        lit += (size_t)picture.width * picture.height - count_dark(&picture);
        framebuffer_free(&picture);
    }
    scene_free(&scene);
    return lit;
}

static void no_light_passes_the_edges_of_a_closed_shape_t39(void **state)
{
    size_t wrong = 0;
    for (double distance = 8; distance < 1e6; distance *= 32) {
        char details[48];
        size_t pixels = 0;
        const size_t lit = light_that_enters(*state, distance, &pixels);
        snprintf(details, sizeof details, "room=bumpy lights=%.0f", distance);
        wrong += report_case("T-39", details, pixels, lit);
    }
    assert_int_equal(wrong, 0);
}

// A globe, as a sphere or a mesh, this far over a floor.
static Scene contact(double gap, bool as_mesh)
{
    Scene scene = shape_scene(shape_plane(vec3(-4, -4, -gap), vec3(8, 0, 0), vec3(0, 8, 0), 5));
    darken(&scene);
    if (as_mesh)
        shape_add(&scene, shape_sphere(24, vec3(0, 0, SPHERE_RADIUS)), 1);
    else
        add_sphere(&scene, vec3(0, 0, 1), 1);
    add_light(&scene, vec3(0.5, 1, 9), 1);
    add_view(&scene, vec3(0.3, -6, 0.4), vec3(0, 0, 0), 8);
    return scene;
}

static void a_shadow_reaches_the_point_of_contact_t40(void **state)
{
    size_t wrong = 0;
    const PictureSettings settings = shadow_settings();
    for (double gap = 1e-3; gap > 5e-7; gap /= 10)
        for (int as_mesh = 0; as_mesh < 2; as_mesh++) {
            char details[48];
            Scene scene = contact(gap, as_mesh == 1);
            snprintf(details, sizeof details, "gap=%.0e ball=%s", gap, as_mesh ? "mesh" : "sphere");
            wrong += picture_report("T-40", details, *state, &scene, &settings);
            scene_free(&scene);
        }
    assert_int_equal(wrong, 0);
}

// A plane whose lattice is exact in float, level or tilted, lit at a sine from one side.
static Scene grazed_plane(double sine, bool tilted)
{
    const Vec3 across = {8, 0, tilted ? 4 : 0}, down = {0, 8, 0}, low = {-4, -4, tilted ? -2 : 0};
    Scene scene = shape_scene(shape_plane(low, across, down, 64));
    const Vec3 normal = vec3_normalize(vec3_cross(across, down));
    const Vec3 beside = vec3_scale(vec3_normalize(across), -16);
    darken(&scene);
    for (size_t i = 0; i < 4; i++)
        scene.materials.data[i].kd = 1;
    add_light(&scene, vec3_add(beside, vec3_scale(normal, 16 * sine)), 1e6);
    add_view(&scene, vec3_scale(normal, 12), vec3(0, 0, 0), 24);
    return scene;
}

// All of the plane faces the light, and nothing stands between.
static void grazing_light_leaves_no_speckles_t41(void **state)
{
    size_t dark = 0;
    const PictureSettings settings = shadow_settings();
    for (int tilted = 0; tilted < 2; tilted++)
        for (double sine = 0.1; sine > 0.9e-7; sine /= 10) {
            char details[48];
            Framebuffer picture;
            Scene scene = grazed_plane(sine, tilted == 1);
            picture_draw(&picture, *state, &scene, &settings);
            snprintf(details, sizeof details, "sine=%.0e plane=%s", sine,
                     tilted ? "tilted" : "level");
            dark += report_case("T-41", details, (size_t)picture.width * picture.height,
                                count_dark(&picture) + picture_count_faults(&picture));
            framebuffer_free(&picture);
            scene_free(&scene);
        }
    assert_int_equal(dark, 0);
}

// A floor, a wall and a ball.
static Scene stand(Vec3 light)
{
    Scene scene = shape_scene(shape_plane(vec3(-4, -4, 0), vec3(8, 0, 0), vec3(0, 8, 0), 8));
    shape_add(&scene, shape_plane(vec3(-4, 4, 0), vec3(8, 0, 0), vec3(0, 0, 4), 8), 2);
    add_sphere(&scene, vec3(1.5, 1, 1.25), 1);
    scene.background = vec3(0, 0, 0);
    add_light(&scene, light, 1);
    add_view(&scene, vec3(1, -9, 5), vec3(0, 0, 1), 40);
    return scene;
}

// Rounding decides on which side of a surface a light exactly on it is; the oracle's light is a
// little in front of it, where it belongs.
static void lights_on_surfaces_and_in_the_eye_are_as_exact_as_others_t42(void **state)
{
    static const struct {
        const char *name;
        Vec3 place, normal;
    } lights[] = {{"above", {0, 0, 3}, {0, 0, 0}},         {"on_floor", {-1.3, 0.4, 0}, {0, 0, 1}},
                  {"on_vertex", {-1, 1, 0}, {0, 0, 1}},    {"on_edge", {-1.5, 1, 0}, {0, 0, 1}},
                  {"on_wall", {0.3, 4, 1.7}, {0, -1, 0}},  {"at_eye", {1, -9, 5}, {0, 0, 0}},
                  {"on_sphere", {1.5, 1, 2.25}, {0, 0, 1}}};
    size_t wrong = 0;
    const PictureSettings settings = shadow_settings();
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        char details[32];
        Scene scene = stand(lights[i].place);
        Scene exact = stand(vec3_add(lights[i].place, vec3_scale(lights[i].normal, 1e-7)));
        snprintf(details, sizeof details, "light=%s", lights[i].name);
        const PictureJudgment judgment = picture_judge(*state, &scene, &exact, &settings);
        wrong += picture_report_judgment("T-42", details, &judgment);
        scene_free(&scene);
        scene_free(&exact);
    }
    assert_int_equal(wrong, 0);
}

typedef enum { SHELL_SPHERE, SHELL_MESH } Shell;

// A light inside a shell over a floor, the eye inside or outside of it.
static Scene shell_scene(Shell shell, bool eye_inside)
{
    Scene scene = shape_scene(shape_plane(vec3(-8, -8, -3), vec3(16, 0, 0), vec3(0, 16, 0), 8));
    scene.background = vec3(0, 0, 0);
    if (shell == SHELL_SPHERE)
        add_sphere(&scene, vec3(0, 0, 0), 2);
    else
        shape_add(&scene, shape_sphere(16, vec3(0, 0, 0)), 1);
    add_light(&scene, vec3(0.5, 0.2, -0.3), 1);
    if (eye_inside)
        add_view(&scene, vec3(-0.5, -0.5, 0.1), vec3(1, 1, 0.3), 90);
    else
        add_view(&scene, vec3(1, -9, 5), vec3(0, 0, -1), 50);
    return scene;
}

static void a_light_in_a_closed_shape_lights_its_inside_alone_t43(void **state)
{
    size_t wrong = 0;
    const PictureSettings settings = shadow_settings();
    for (int eye = 0; eye < 2; eye++)
        for (Shell shell = SHELL_SPHERE; shell <= SHELL_MESH; shell++) {
            char details[48];
            Scene scene = shell_scene(shell, eye == 1);
            snprintf(details, sizeof details, "shell=%s eye=%s",
                     shell == SHELL_MESH ? "mesh" : "sphere", eye ? "inside" : "outside");
            wrong += picture_report("T-43", details, *state, &scene, &settings);
            scene_free(&scene);
        }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_convex_shape_casts_no_shadow_on_itself_t39),
        cmocka_unit_test(light_enters_a_room_through_its_door_alone_t39),
        cmocka_unit_test(no_light_passes_the_edges_of_a_closed_shape_t39),
        cmocka_unit_test(a_shadow_reaches_the_point_of_contact_t40),
        cmocka_unit_test(grazing_light_leaves_no_speckles_t41),
        cmocka_unit_test(lights_on_surfaces_and_in_the_eye_are_as_exact_as_others_t42),
        cmocka_unit_test(a_light_in_a_closed_shape_lights_its_inside_alone_t43),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
