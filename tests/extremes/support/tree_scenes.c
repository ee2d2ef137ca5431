// SPDX-License-Identifier: MIT
// Each function makes one scene.
#include "tree_scenes.h"

#include "check.h"
#include "shapes.h"

static void add_spheres(Scene *scene, Random *random, int count, double radius)
{
    Error error = {0};
    for (int i = 0; i < count; i++) {
        const Sphere sphere = {random_in_cube(random, 1), random_between(random, 0, radius), 1};
        require(array_push(&scene->spheres, sphere, &error), &error);
    }
}

static Scene far_sphere_scene(Random *random)
{
    (void)random;
    return shape_scene(shape_sphere(12, shape_center(18)));
}

static Scene bumpy_scene(Random *random)
{
    return shape_scene(shape_bumpy(random, vec3(1, 2, 3)));
}

static Scene fan_scene(Random *random)
{
    (void)random;
    return shape_scene(shape_fan(400));
}

static Scene plane_scene(Random *random)
{
    (void)random;
    return shape_scene(shape_plane(vec3(0, 0, 7), vec3(1, 0, 0), vec3(0, 1, 0), 15));
}

static Scene tilted_plane_scene(Random *random)
{
    (void)random;
    return shape_scene(shape_plane(vec3(3, 3, 3), vec3(1, 0.3, 0.1), vec3(-0.2, 1, 0.4), 15));
}

static Scene cube_scene(Random *random)
{
    (void)random;
    return shape_scene(shape_cube(4, 6));
}

static Scene soup_scene(Random *random)
{
    return shape_scene(shape_soup(random, 500, 0.3));
}

static Scene sliver_scene(Random *random)
{
    Scene scene = shape_scene(shape_soup(random, 500, 0.5));
    Mesh *mesh = &scene.objects.data[0].mesh;
    for (size_t triangle = 0; triangle < 500; triangle++)
        for (int axis = 0; axis < 3; axis++) {
            const double a = mesh->positions[3 * triangle][axis];
            const double b = mesh->positions[3 * triangle + 1][axis];
            double *c = &mesh->positions[3 * triangle + 2][axis];
            *c = shape_rounded(0.5 * (a + b) + 1e-5 * *c);
        }
    return scene;
}

// The same cube three times: every hit is a tie.
static Scene coincident_scene(Random *random)
{
    (void)random;
    Scene scene = shape_scene(shape_cube(1, 4));
    shape_add(&scene, shape_cube(1, 4), 2);
    shape_add(&scene, shape_cube(1, 4), 3);
    return scene;
}

static Scene nested_scene(Random *random)
{
    Scene scene = shape_scene(shape_soup(random, 1, 1));
    for (int i = 1; i < 300; i++) {
        const double size = 0.01 * i;
        shape_add(&scene, shape_triangle(vec3(size, 0, 0), vec3(0, size, 0), vec3(-size, -size, 0)),
                  1);
    }
    return scene;
}

// Each triangle half as large and half as far as the one before.
static Scene spiral_scene(Random *random)
{
    Scene scene = shape_scene(shape_soup(random, 10, 0.5));
    for (int i = 0; i < 120; i++) {
        const double s = ldexp(1, -i);
        shape_add(&scene, shape_triangle(vec3(s, 0, 0), vec3(s, s, 0.2 * s), vec3(0, s, s)), 1);
    }
    return scene;
}

static Scene mixed_scene(Random *random)
{
    Scene scene = shape_scene(shape_soup(random, 300, 0.4));
    add_spheres(&scene, random, 20, 0.3);
    return scene;
}

const TreeScene tree_scenes[TREE_SCENES] = {
    {"far_sphere", far_sphere_scene},
    {"bumpy", bumpy_scene},
    {"fan", fan_scene},
    {"plane", plane_scene},
    {"tilted_plane", tilted_plane_scene},
    {"cube", cube_scene},
    {"soup", soup_scene},
    {"slivers", sliver_scene},
    {"coincident", coincident_scene},
    {"nested", nested_scene},
    {"spiral", spiral_scene},
    {"mixed", mixed_scene},
};

Scene tree_scene_make(size_t number)
{
    Random random = {2500 + number};
    return tree_scenes[number].make(&random);
}
