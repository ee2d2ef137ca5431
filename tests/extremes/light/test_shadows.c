// SPDX-License-Identifier: MIT
// Shadows that are hard to get right: on convex shapes of any size and place, in rooms with and
// without a door, under contacts, in grazing light, and of lights on and inside shapes.
#include "support/scene_text.h"
#include "support/shapes.h"
#include "support/varied_scene.h"

#include <string.h>

// With these statements, only light makes a pixel other than black.
#define DARK "ambient 0\nbackground 0 0 0\nup 0.01 0.02 1\n"

static PictureSettings shadow_settings(void)
{
    return picture_settings((uint32_t)tier_size(48, 128));
}

// Returns a globe lit from beside the eye. Everything that is visible is lit.
static Scene lit_globe(void)
{
    Scene scene = scene_text_parse(DARK "light 6 -20 5 1\ncamera 5 -18 4 0 0 0 14\n");
    shape_add(&scene, shape_sphere(20, vec3(0, 0, 0)), 1);
    return scene;
}

// Returns the globe at a place far away, rounded to float there.
static Scene translated_globe(Vec3 by)
{
    Scene scene = lit_globe();
    Mesh *mesh = &scene.objects.data[0].mesh;
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
        shape_set_vertex(mesh, vertex, vec3_add(shape_vertex(mesh, vertex), by));
    Vec3 *const places[3] = {&scene.lights.data[0].position, &scene.viewpoints.data[0].eye,
                             &scene.viewpoints.data[0].look_at};
    for (int i = 0; i < 3; i++)
        *places[i] = vec3_add(*places[i], by);
    return scene;
}

static void a_convex_shape_casts_no_shadow_on_itself_t39(void **state)
{
    const PictureSettings settings = shadow_settings();
    for (int exponent = 0; exponent <= 17; exponent += tier() == 0 ? 17 : 1)
        outcome_report(
            picture_judge("T-39", *state, translated_globe(shape_center(exponent)), &settings),
            "translation=2^%d", exponent);
    for (int exponent = -20; exponent <= 20; exponent += tier() == 0 ? 10 : 2) {
        Scene scene = lit_globe();
        varied_scene_scale(&scene, exponent);
        outcome_report(picture_judge("T-39", *state, scene, &settings), "scale=2^%d", exponent);
    }
}

// Returns how many pixels are lit. Frees the scene.
static size_t count_lit(const Studio *studio, Scene scene, const PictureSettings *settings)
{
    static const float black[3] = {0, 0, 0};
    Framebuffer picture = picture_draw_once(studio, scene, settings);
    const size_t lit = picture_count_other(&picture, black);
    assert_int_equal(picture_count_faults(&picture), 0);
    framebuffer_free(&picture);
    return lit;
}

// Returns a room of thin walls around the eye, with the lights outside.
static Scene dark_room(bool has_door)
{
    Scene scene = scene_text_parse(DARK "light 3.1 2.9 -1.3 1\nlight -5 4 2 1\n"
                                        "camera -0.5 -0.25 0.2 0.3 0.2 -1 120\n");
    Mesh mesh = shape_cube(2, 6);
    for (size_t i = mesh.triangle_count - 1; has_door && i >= 160; i--)
        memcpy(mesh.triangles[i], mesh.triangles[i - 4], sizeof *mesh.triangles);
    shape_add(&scene, mesh, 1);
    return scene;
}

static void light_enters_a_room_through_its_door_alone_t39(void **state)
{
    PictureSettings settings = shadow_settings();
    outcome_report(picture_judge("T-39", *state, dark_room(true), &settings), "room=door");
    settings.render.samples = 2;
    const size_t samples = (size_t)settings.render.width * settings.render.height * 4;
    outcome_report(outcome_of("T-39", samples, count_lit(*state, dark_room(false), &settings)),
                   "room=closed");
}

// Returns a point of a random edge, or one of the edge's ends.
static Vec3 random_edge_point(const Mesh *mesh, Random *random, bool at_end)
{
    const uint32_t *corners = mesh->triangles[random_below(random, (uint32_t)mesh->triangle_count)];
    const Vec3 a = shape_vertex(mesh, corners[0]), b = shape_vertex(mesh, corners[1]);
    const double along = at_end ? 0 : random_between(random, 0, 1);
    return vec3_add(a, vec3_scale(vec3_sub(b, a), along));
}

// Returns a closed shape with sharp edges, lights all around it, and a view from inside of an edge
// or vertex. The narrowest views show a single rounded point in neighboring pixels.
static Scene lit_from_outside(double distance, size_t view, Random *random)
{
    Error error = {0};
    Random shape = {3939};
    Scene scene = scene_text_parse(DARK "camera 0 0 0 1 0 0 40\n");
    Viewpoint *viewpoint = &scene.viewpoints.data[0];
    shape_add(&scene, shape_bumpy(&shape, vec3(0, 0, 0)), 1);
    for (int i = 0; i < 32; i++) {
        const Light light = light_white(vec3_scale(random_unit(&shape), distance), 1);
        require(array_push(&scene.lights, light, &error), &error);
    }
    viewpoint->look_at = random_edge_point(&scene.objects.data[0].mesh, random, view % 4 == 0);
    viewpoint->fov_degrees = 40 * pow(0.1, (double)(view % 7));
    return scene;
}

static void no_light_passes_the_edges_of_a_closed_shape_t39(void **state)
{
    const PictureSettings settings = shadow_settings();
    const size_t views = tier_size(28, 280);
    const size_t pixels = views * settings.render.width * settings.render.height;
    for (double distance = 8; distance < 1e6; distance *= 32) {
        Random random = {39};
        size_t lit = 0;
        for (size_t view = 0; view < views; view++)
            lit += count_lit(*state, lit_from_outside(distance, view, &random), &settings);
        outcome_report(outcome_of("T-39", pixels, lit), "room=bumpy lights=%.0f", distance);
    }
}

// Returns a globe this far above a floor.
static Scene contact(double gap, bool as_mesh)
{
    Scene scene = scene_text_parse(DARK "light 0.5 1 9 1\ncamera 0.3 -6 0.4 0 0 0 8\n%s",
                                   as_mesh ? "" : "material 1\nsphere 0 0 1 1\n");
    shape_add(&scene, shape_plane(vec3(-4, -4, -gap), vec3(8, 0, 0), vec3(0, 8, 0), 5), 1);
    if (as_mesh)
        shape_add(&scene, shape_sphere(24, vec3(0, 0, SPHERE_RADIUS)), 1);
    return scene;
}

static void a_shadow_reaches_the_point_of_contact_t40(void **state)
{
    const PictureSettings settings = shadow_settings();
    for (double gap = 1e-3; gap > 5e-7; gap /= 10)
        for (int as_mesh = 0; as_mesh < 2; as_mesh++)
            outcome_report(picture_judge("T-40", *state, contact(gap, as_mesh == 1), &settings),
                           "gap=%.0e ball=%s", gap, as_mesh ? "mesh" : "sphere");
}

// Returns a plane whose lattice is exact in float, lit at a sine from one side.
static Scene grazed_plane(double sine, bool is_tilted)
{
    const double tilt = is_tilted ? 4 : 0;
    const Vec3 across = {8, 0, tilt}, down = {0, 8, 0};
    const Vec3 normal = vec3_normalize(vec3_cross(across, down)), eye = vec3_scale(normal, 12);
    const Vec3 light =
        vec3_add(vec3_scale(vec3_normalize(across), -16), vec3_scale(normal, 16 * sine));
    Scene scene = scene_text_parse(DARK "light %.17g %.17g %.17g 1e6\n"
                                        "camera %.17g %.17g %.17g 0 0 0 24\n",
                                   light.x, light.y, light.z, eye.x, eye.y, eye.z);
    scene.materials.data[1].kd = 1;
    shape_add(&scene, shape_plane(vec3(-4, -4, -tilt / 2), across, down, 64), 1);
    return scene;
}

// All of the plane faces the light, and nothing is between them.
static void grazing_light_leaves_no_speckles_t41(void **state)
{
    const PictureSettings settings = shadow_settings();
    const size_t pixels = (size_t)settings.render.width * settings.render.height;
    for (int tilted = 0; tilted < 2; tilted++)
        for (double sine = 0.1; sine > 0.9e-7; sine /= 10) {
            const size_t lit = count_lit(*state, grazed_plane(sine, tilted == 1), &settings);
            outcome_report(outcome_of("T-41", pixels, pixels - lit), "sine=%.0e plane=%s", sine,
                           tilted ? "tilted" : "level");
        }
}

// Returns a floor, a wall and a ball.
static Scene stand(Vec3 light)
{
    Scene scene = scene_text_parse("background 0 0 0\nup 0.01 0.02 1\nlight %.17g %.17g %.17g 1\n"
                                   "camera 1 -9 5 0 0 1 40\nmaterial 1\nsphere 1.5 1 1.25 1\n",
                                   light.x, light.y, light.z);
    shape_add(&scene, shape_plane(vec3(-4, -4, 0), vec3(8, 0, 0), vec3(0, 8, 0), 8), 1);
    shape_add(&scene, shape_plane(vec3(-4, 4, 0), vec3(8, 0, 0), vec3(0, 0, 4), 8), 2);
    return scene;
}

// Rounding decides on which side of a surface a light exactly on it is. The oracle's light is
// slightly in front of the surface.
static void lights_on_surfaces_and_in_the_eye_are_as_exact_as_others_t42(void **state)
{
    static const struct {
        const char *name;
        Vec3 place, normal;
    } lights[] = {{"above", {0, 0, 3}, {0, 0, 0}},         {"on_floor", {-1.3, 0.4, 0}, {0, 0, 1}},
                  {"on_vertex", {-1, 1, 0}, {0, 0, 1}},    {"on_edge", {-1.5, 1, 0}, {0, 0, 1}},
                  {"on_wall", {0.3, 4, 1.7}, {0, -1, 0}},  {"at_eye", {1, -9, 5}, {0, 0, 0}},
                  {"on_sphere", {1.5, 1, 2.25}, {0, 0, 1}}};
    const PictureSettings settings = shadow_settings();
    for (size_t i = 0; i < COUNT(lights); i++) {
        const Vec3 before = vec3_add(lights[i].place, vec3_scale(lights[i].normal, 1e-7));
        outcome_report(
            picture_judge_beside("T-42", *state, stand(lights[i].place), stand(before), &settings),
            "light=%s", lights[i].name);
    }
}

// Returns a light inside a shell above a floor. The eye is inside or outside the shell.
static Scene shell_scene(bool as_mesh, bool eye_inside)
{
    Scene scene =
        scene_text_parse("background 0 0 0\nup 0.01 0.02 1\nlight 0.5 0.2 -0.3 1\ncamera %s\n%s",
                         eye_inside ? "-0.5 -0.5 0.1 1 1 0.3 90" : "1 -9 5 0 0 -1 50",
                         as_mesh ? "" : "material 1\nsphere 0 0 0 2\n");
    shape_add(&scene, shape_plane(vec3(-8, -8, -3), vec3(16, 0, 0), vec3(0, 16, 0), 8), 1);
    if (as_mesh)
        shape_add(&scene, shape_sphere(16, vec3(0, 0, 0)), 1);
    return scene;
}

static void a_light_in_a_closed_shape_lights_its_inside_alone_t43(void **state)
{
    const PictureSettings settings = shadow_settings();
    for (int inside = 0; inside < 2; inside++)
        for (int as_mesh = 0; as_mesh < 2; as_mesh++)
            outcome_report(
                picture_judge("T-43", *state, shell_scene(as_mesh == 1, inside == 1), &settings),
                "shell=%s eye=%s", as_mesh ? "mesh" : "sphere", inside ? "inside" : "outside");
}

RUN_TESTS(picture_setup, picture_teardown, EXTREME(a_convex_shape_casts_no_shadow_on_itself_t39),
          EXTREME(light_enters_a_room_through_its_door_alone_t39),
          EXTREME(no_light_passes_the_edges_of_a_closed_shape_t39),
          EXTREME(a_shadow_reaches_the_point_of_contact_t40),
          EXTREME(grazing_light_leaves_no_speckles_t41),
          EXTREME(lights_on_surfaces_and_in_the_eye_are_as_exact_as_others_t42),
          EXTREME(a_light_in_a_closed_shape_lights_its_inside_alone_t43))
