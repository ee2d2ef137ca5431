// SPDX-License-Identifier: MIT
// Parses lights, cameras and spheres from text, and adds meshes.
#include "certainty/extreme_scenes.h"

#include "extremes/support/check.h"
#include "extremes/support/shapes.h"
#include "unit/parsed.h"

static Scene slivers(void)
{
    Scene scene = parsed_format("size 384 384\n"
                                "light 0.5 -1 2 0.7\n"
                                "light -2 0.3 0.4 0.4\n"
                                "camera 0.9 -1.6 0.8 0.1 0 0 50\n"
                                "camera 0.3 0.02 0.9 0 0 0 20\n");
    Random random = {7};
    shape_add(&scene, shape_fan(8000), 1);
    for (int i = 0; i < 300; i++) {
        const Vec3 a = random_in_cube(&random, 1), along = random_in_cube(&random, 1);
        const double width = exp2(-4 - 20 * random_between(&random, 0, 1));
        const Vec3 aside = vec3_scale(random_in_cube(&random, 1), width);
        shape_add(&scene, shape_triangle(a, vec3_add(a, along), vec3_add(a, aside)), 2);
    }
    return scene;
}

static Scene far_away(void)
{
    const Vec3 center = shape_center(16);
    Scene scene = parsed_format("size 384 384\n"
                                "light 65540 -49157 32777 0.8\n"
                                "light 65530 -49150 32771 0.4\n"
                                "camera 65545 -49160 32772 65536 -49152 32768 40\n");
    shape_add(&scene, shape_sphere(40, center), 3);
    shape_add(&scene,
              shape_plane(vec3(center.x - 6, center.y - 6, center.z - 2), vec3(12, 0, 0),
                          vec3(0, 12, 0), 6),
              3);
    return scene;
}

static Scene planets(void)
{
    Scene scene = parsed_format("size 384 256\n"
                                "define ground matte diffuse 0.6 0.6 0.5 reflectivity 0.3\n"
                                "light 3 -4 6 0.7\n"
                                "light -500 300 900 0.4\n"
                                "material ground\n"
                                "sphere 0 0 -10000000.5 10000000\n"
                                "material 2\n"
                                "sphere 1.4 0.8 0 0.5\n"
                                "sphere -40 900 60 100\n"
                                "sphere 1.2 -0.7 -0.49 0.0001\n"
                                "camera 4 -3 0.4 0 0 0 40\n"
                                "camera 1.21 -0.72 -0.485 1.2 -0.7 -0.49 12\n");
    shape_add(&scene, shape_cube(0.5, 3), 3);
    return scene;
}

static Scene contacts(void)
{
    Scene scene = parsed_format("size 384 384\n"
                                "define floor blinn_phong diffuse 0.3 0.5 0.4 reflectivity 0.2\n"
                                "light 2 -3 4 0.6\n"
                                "light -3 -1 0.0 0.5\n"
                                "light 0.5 3 0.5 0.3\n"
                                "material 2\n"
                                "sphere 1 0.25 -0.25 0.25\n"
                                "sphere 0.75 -0.25 -0.375 0.125\n"
                                "camera 3 -2 1.2 0.2 0 -0.2 42\n"
                                "camera 2.5 1.5 -0.4 0.2 0 -0.3 42\n");
    shape_add(&scene, shape_cube(0.5, 4), 1);
    const uint32_t floor = (uint32_t)scene.materials.count - 1;
    shape_add(&scene, shape_plane(vec3(-2, -2, -0.5), vec3(4, 0, 0), vec3(0, 4, 0), 5), floor);
    return scene;
}

static Scene mirror_room(void)
{
    Scene scene = parsed_format("size 384 384\n"
                                "max_level 8\n"
                                "define wall matte diffuse 0.4 0.6 0.7 reflectivity 0.8\n"
                                "define ball blinn_phong diffuse 0.8 0.3 0.2 reflectivity 0.5\n"
                                "light 0.7 -0.6 0.8 0.5\n"
                                "light -0.4 0.8 -0.3 0.4\n"
                                "material ball\n"
                                "sphere -0.2 0.1 -0.4 0.3\n"
                                "camera 0.8 -0.75 0.3 -0.3 0.2 -0.2 70\n");
    shape_add(&scene, shape_cube(1, 2), (uint32_t)scene.materials.count - 2);
    return scene;
}

static Scene mixed_scales(void)
{
    Scene scene = parsed_format("size 384 384\n"
                                "light 900 -400 700 0.6\n"
                                "light 0.01 -0.012 0.02 0.3\n"
                                "camera 0.004 -0.006 0.003 0 0 0 45\n"
                                "camera 300 -500 200 0 0 0 45\n");
    Random random = {11};
    Mesh bump = shape_bumpy(&random, vec3(0, 0, 0));
    for (size_t vertex = 0; vertex < bump.vertex_count; vertex++)
        for (int axis = 0; axis < 3; axis++)
            bump.positions[vertex][axis] *= 0x1p-13;
    shape_add(&scene, bump, 3);
    shape_add(&scene, shape_plane(vec3(-90, -90, -0.001), vec3(180, 0, 0), vec3(0, 180, 0), 7), 1);
    return scene;
}

static Scene soup(void)
{
    Scene scene = parsed_format("size 384 384\n"
                                "light 3 -2 4 0.5\n"
                                "light 0.1 0.05 0.02 0.4\n"
                                "camera 2.2 -1.8 1.1 0 0 0 50\n"
                                "camera 0.02 0.03 -0.01 1 0.4 0.2 90\n");
    Random random = {3};
    shape_add(&scene, shape_soup(&random, 4000, 0.2), 3);
    shape_add(&scene, shape_soup(&random, 4000, 0.001), 2);
    return scene;
}

// Two planes cross at an angle of 1e-6 radians. A plane beyond the light casts no shadow on them.
static Scene crossing(void)
{
    Scene scene = parsed_format("size 384 384\n"
                                "light 0.3 -0.2 1 0.6\n"
                                "camera 0.3 -2 1.5 0 0 0 40\n");
    shape_add(&scene, shape_plane(vec3(-1, -1, 0), vec3(2, 0, 0), vec3(0, 2, 0), 5), 1);
    shape_add(&scene, shape_plane(vec3(-1, -1, -1e-6), vec3(2, 0, 2e-6), vec3(0, 2, 0), 4), 2);
    shape_add(&scene, shape_plane(vec3(0, -0.5, 1.3), vec3(0.6, 0, 0), vec3(0, 0.6, 0), 1), 1);
    return scene;
}

static Mesh coincident_floor(void)
{
    return shape_plane(vec3(-5, -5, -2.3), vec3(10, 0, 1), vec3(0, 10, 0), 6);
}

Scene extreme_coincident(void)
{
    Scene scene = parsed_format("size 384 384\n"
                                "light 6 -5 9 0.6\n"
                                "light -7 -2 4 0.4\n"
                                "camera 5 -9 4 0 0 -0.4 42\n");
    Random random = {21};
    const Vec3 center = {0.1, -0.2, 0.3};
    shape_add(&scene, shape_sphere(14, center), 3);
    shape_add(&scene, shape_reordered(shape_sphere(14, center), &random), 2);
    shape_add(&scene, shape_reordered(coincident_floor(), &random), 1);
    shape_add(&scene, coincident_floor(), 3);
    return scene;
}

Scene extreme_marbles(uint64_t seed)
{
    Scene scene = parsed_format("size 384 384\n"
                                "define chrome matte diffuse 0.5 0.5 0.6 reflectivity 0.5\n"
                                "light 3 -2 4 0.5\n"
                                "light 0.1 0.05 0.02 0.4\n"
                                "camera 2.2 -1.8 1.1 0 0 0 50\n"
                                "material chrome\n"
                                "sphere 0 0 -10001 10000\n");
    Random random = {seed};
    Sphere ball = scene.spheres.data[0];
    for (int i = 0; i < 200; i++) {
        const double before = ball.radius;
        Error error = {0};
        ball.radius = exp2(random_between(&random, -12, -2));
        if (i % 4 == 3)
            ball.center.x += before + (i % 8 == 3 ? ball.radius : -ball.radius);
        else
            ball.center = random_in_cube(&random, 1);
        require(array_push(&scene.spheres, ball, &error), &error);
    }
    return scene;
}

static Scene marbles(void)
{
    return extreme_marbles(13);
}

const ExtremeScene extreme_scenes[] = {
    {"slivers", slivers},   {"far_away", far_away},       {"planets", planets},
    {"contacts", contacts}, {"mirror_room", mirror_room}, {"mixed_scales", mixed_scales},
    {"soup", soup},         {"crossing", crossing},       {"marbles", marbles},
};

const size_t extreme_scene_count = sizeof extreme_scenes / sizeof extreme_scenes[0];
