// SPDX-License-Identifier: MIT
// Tests difficult shadows: inside a closed shape with lights around it, at points of contact, and
// from lights that lie on surfaces or in the eye.
#include "support/shapes.h"
#include "support/varied_scene.h"
#include "unit/parsed.h"

// With these statements, all unlit pixels are black.
#define DARK "ambient 0\nbackground 0 0 0\nup 0.01 0.02 1\n"

static PictureSettings shadow_settings(void)
{
    return picture_settings((uint32_t)tier_size(48, 128));
}

// Returns how many pixels are lit. Frees the scene.
static size_t count_lit(const Studio *studio, Scene scene, const PictureSettings *settings)
{
    static const float black[3] = {0, 0, 0};
    FREED_BY(framebuffer_free) Framebuffer picture = picture_draw_once(studio, scene, settings);
    const size_t lit = picture_count_other(&picture, black);
    assert_int_equal(picture_count_faults(&picture), 0);
    return lit;
}

// Returns a point of a random edge, or one of the edge's ends.
static Vec3 random_edge_point(const Mesh *mesh, Random *random, bool at_end)
{
    const uint32_t *corners = mesh->triangles[random_below(random, (uint32_t)mesh->triangle_count)];
    const Vec3 a = shape_vertex(mesh, corners[0]), b = shape_vertex(mesh, corners[1]);
    const double along = at_end ? 0 : random_between(random, 0, 1);
    return vec3_add(a, vec3_scale(vec3_sub(b, a), along));
}

// Returns a closed shape with sharp edges, lights all around it, and a camera inside that looks at
// an edge or vertex. In the narrowest views, hit points of neighboring pixels round to one point.
static Scene lit_from_outside(double distance, size_t view, Random *random)
{
    Error error = {0};
    Random shape = {3939};
    Scene scene = parsed_format(DARK "camera 0 0 0 1 0 0 40\n");
    Viewpoint *viewpoint = &scene.viewpoints.data[0];
    shape_add(&scene, shape_bumpy(&shape, vec3(0, 0, 0)), 1);
    for (int i = 0; i < 32; i++) {
        const Light light = light_white(vec3_scale(random_direction(&shape), distance), 1);
        require(array_push(&scene.lights, light, &error), &error);
    }
    viewpoint->look_at = random_edge_point(&scene.objects.data[0].mesh, random, view % 4 == 0);
    viewpoint->fov_degrees = 40 * pow(0.1, (double)(view % 7));
    return scene;
}

EXTREME(no_light_passes_the_edges_of_a_closed_shape_t39)
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

// Returns a globe above a floor, with `gap` between them.
static Scene contact(double gap, bool as_mesh)
{
    Scene scene = parsed_format(DARK "light 0.5 1 9 1\ncamera 0.3 -6 0.4 0 0 0 8\n%s",
                                as_mesh ? "" : "material 1\nsphere 0 0 1 1\n");
    shape_add(&scene, shape_plane(vec3(-4, -4, -gap), vec3(8, 0, 0), vec3(0, 8, 0), 5), 1);
    if (as_mesh)
        shape_add(&scene, shape_sphere(24, vec3(0, 0, SPHERE_RADIUS)), 1);
    return scene;
}

EXTREME(a_shadow_reaches_the_point_of_contact_t40)
{
    const PictureSettings settings = shadow_settings();
    for (double gap = 1e-3; gap > 5e-7; gap /= 10)
        for (int as_mesh = 0; as_mesh < 2; as_mesh++)
            outcome_report(picture_judge("T-40", *state, contact(gap, as_mesh == 1), &settings),
                           "gap=%.0e ball=%s", gap, as_mesh ? "mesh" : "sphere");
}

// A corner of the wall, and the vectors along two of its edges. Points on this wall are rounded,
// unlike points on the floor.
static const Vec3 wall[] = {{-4.1, 3.5, 0}, {8.3, 1.05, 0}, {0.1, -0.84, 4}};

static Vec3 wall_point(double across, double up)
{
    return vec3_add(wall[0], vec3_add(vec3_scale(wall[1], across), vec3_scale(wall[2], up)));
}

// Returns a floor, a wall and a ball.
static Scene stand(Vec3 light)
{
    Scene scene = parsed_format("background 0 0 0\nup 0.01 0.02 1\nlight %.17g %.17g %.17g 1\n"
                                "camera 1 -9 5 0 0 1 40\nmaterial 1\nsphere 1.5 1 1.25 1\n",
                                light.x, light.y, light.z);
    shape_add(&scene, shape_plane(vec3(-4, -4, 0), vec3(8, 0, 0), vec3(0, 8, 0), 8), 1);
    shape_add(&scene, shape_plane(wall[0], wall[1], wall[2], 8), 2);
    return scene;
}

// If a light is exactly on a surface, rounding decides on which side it is. The oracle's light is
// slightly in front of the surface.
EXTREME(lights_on_surfaces_and_in_the_eye_are_as_exact_as_others_t42)
{
    const Vec3 wall_normal = vec3_normalize(vec3_cross(wall[1], wall[2]));
    const struct {
        const char *name;
        Vec3 place, normal;
    } lights[] = {{"above", {0, 0, 3}, {0, 0, 0}},
                  {"on_floor", {-1.3, 0.4, 0}, {0, 0, 1}},
                  {"on_vertex", {-1, 1, 0}, {0, 0, 1}},
                  {"on_edge", {-1.5, 1, 0}, {0, 0, 1}},
                  {"on_wall", wall_point(0.53, 0.43), wall_normal},
                  {"high_on_wall", wall_point(0.21, 0.93), wall_normal},
                  {"at_eye", {1, -9, 5}, {0, 0, 0}},
                  {"on_sphere", {1.5, 1, 2.25}, {0, 0, 1}}};
    const PictureSettings settings = shadow_settings();
    for (size_t i = 0; i < COUNT(lights); i++) {
        const Vec3 before = vec3_add(lights[i].place, vec3_scale(lights[i].normal, 1e-7));
        outcome_report(
            picture_judge_beside("T-42", *state, stand(lights[i].place), stand(before), &settings),
            "light=%s", lights[i].name);
    }
}

FIXTURES(picture_setup, picture_teardown)
