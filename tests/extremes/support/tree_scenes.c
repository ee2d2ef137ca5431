// SPDX-License-Identifier: MIT
// Each scene starts with one mesh. Some scenes get more objects.
#include "tree_scenes.h"

#include "check.h"
#include "shapes.h"

const char *const tree_scene_names[TREE_SCENES] = {
    "far_sphere", "bumpy",      "fan",    "plane",  "tilted_plane", "cube",        "soup",
    "slivers",    "coincident", "nested", "spiral", "mixed",        "one_triangle"};

enum { SLIVERS = 7, COINCIDENT, NESTED, SPIRAL, MIXED, ONE_TRIANGLE };

// Moves the third corner of each triangle almost to the middle m of the other two corners: from p
// to m + 1e-5 * p.
static Mesh slivers(Random *random)
{
    Mesh mesh = shape_soup(random, 500, 0.5);
    for (size_t i = 0; i < 1500; i += 3) {
        const Vec3 middle =
            vec3_scale(vec3_add(shape_vertex(&mesh, i), shape_vertex(&mesh, i + 1)), 0.5);
        shape_set_vertex(&mesh, i + 2,
                         vec3_add(middle, vec3_scale(shape_vertex(&mesh, i + 2), 1e-5)));
    }
    return mesh;
}

static Mesh first_mesh(size_t number, Random *random)
{
    switch (number) {
    case 0:
        return shape_sphere(12, shape_center(18));
    case 1:
        return shape_bumpy(random, vec3(1, 2, 3));
    case 2:
        return shape_fan(400);
    case 3:
        return shape_plane(vec3(0, 0, 7), vec3(1, 0, 0), vec3(0, 1, 0), 15);
    case 4:
        return shape_plane(vec3(3, 3, 3), vec3(1, 0.3, 0.1), vec3(-0.2, 1, 0.4), 15);
    case 5:
        return shape_cube(4, 6);
    case 6:
        return shape_soup(random, 500, 0.3);
    case SLIVERS:
        return slivers(random);
    case COINCIDENT:
        return shape_cube(1, 4);
    case NESTED:
        return shape_soup(random, 1, 1);
    case SPIRAL:
        return shape_soup(random, 10, 0.5);
    case ONE_TRIANGLE:
        return shape_triangle(vec3(-1, 0, -0.75), vec3(1, 0.5, -1), vec3(0.25, -0.5, 1));
    default:
        return shape_soup(random, 300, 0.4);
    }
}

static void add_triangle(Scene *scene, Vec3 a, Vec3 b, Vec3 c)
{
    shape_add(scene, shape_triangle(a, b, c), 1);
}

static void add_sphere(Scene *scene, Random *random)
{
    Error error = {0};
    const Sphere sphere = {random_in_cube(random, 1), random_between(random, 0, 0.3), 1};
    require(array_push(&scene->spheres, sphere, &error), &error);
}

Scene tree_scene_make(size_t number)
{
    Random random = {2500 + number};
    Scene scene = shape_scene(first_mesh(number, &random));
    // Two copies of the cube make every hit a tie.
    for (uint32_t material = 2; number == COINCIDENT && material < 4; material++)
        shape_add(&scene, shape_cube(1, 4), material);
    for (int i = 1; number == NESTED && i < 300; i++) {
        const double s = 0.01 * i;
        add_triangle(&scene, vec3(s, 0, 0), vec3(0, s, 0), vec3(-s, -s, 0));
    }
    // Each triangle is half as large as the one before, and at half its distance from the origin.
    for (int i = 0; number == SPIRAL && i < 120; i++) {
        const double s = ldexp(1, -i);
        add_triangle(&scene, vec3(s, 0, 0), vec3(s, s, 0.2 * s), vec3(0, s, s));
    }
    for (int i = 0; number == MIXED && i < 20; i++)
        add_sphere(&scene, &random);
    return scene;
}
