// SPDX-License-Identifier: MIT
// Many reflections: between parallel mirrors the color is a geometric series, and out of a closed
// mirror box no ray ever comes.
#include "support/check.h"
#include "support/picture.h"
#include "support/random.h"
#include "support/report.h"
#include "support/rotation.h"
#include "support/shapes.h"
#include "support/tier.h"

// All that is seen is the material's own color, so much of it that of what it reflects.
static uint32_t add_mirror(Scene *scene, float reflectivity)
{
    Error error = {0};
    Material mirror = material_of_shader(SHADER_SILHOUETTE);
    mirror.diffuse[0] = 0.5f;
    mirror.diffuse[1] = 0.75f;
    mirror.diffuse[2] = 0.2f;
    mirror.reflectivity = reflectivity;
    require(array_push(&scene->materials, mirror, &error), &error);
    return (uint32_t)scene->materials.count - 1;
}

static void set_view(Scene *scene, Vec3 eye, Vec3 look_at, double fov)
{
    Error error = {0};
    const Viewpoint viewpoint = {eye, look_at, {0, 0, 1}, fov, 0};
    require(array_push(&scene->viewpoints, viewpoint, &error), &error);
}

// Two mirrors face each other at x = -1 and x = 1, the eye between them.
static Scene parallel_mirrors(void)
{
    Error error = {0};
    Scene scene;
    require(scene_init(&scene, &error), &error);
    const uint32_t mirror = add_mirror(&scene, 0.25f);
    shape_add(&scene, shape_plane(vec3(-1, -20, -20), vec3(0, 40, 0), vec3(0, 0, 40), 1), mirror);
    shape_add(&scene, shape_plane(vec3(1, -20, -20), vec3(0, 40, 0), vec3(0, 0, 40), 1), mirror);
    scene.background = vec3(0.25, 1, 0.5);
    set_view(&scene, vec3(0, 0, 0), vec3(1, 0.001, 0.002), 5);
    return scene;
}

// (1 - r) c (1 + r + ... + r^(level - 1)) + r^level b.
static double mirrored_color(double color, double background, uint32_t level)
{
    double sum = 0, weight = 1;
    for (uint32_t i = 0; i < level; i++) {
        sum += weight * 0.75 * color;
        weight *= 0.25;
    }
    return sum + weight * background;
}

static size_t count_off(const Framebuffer *picture, const Scene *scene, uint32_t level)
{
    size_t off = 0;
    const float *diffuse = scene->materials.data[scene->materials.count - 1].diffuse;
    const double background[3] = {scene->background.x, scene->background.y, scene->background.z};
    const double allowed = 4 * 0x1p-24 * (level > 0 ? level : 1);
    for (size_t pixel = 0; pixel < (size_t)picture->width * picture->height; pixel++) {
        bool right = true;
        for (int channel = 0; channel < 3; channel++) {
            const double expected =
                mirrored_color((double)diffuse[channel], background[channel], level);
            right = right &&
                    fabs((double)picture->pixels[pixel][channel] - expected) <= allowed * expected;
        }
        off += !right;
    }
    return off;
}

static void colors_between_parallel_mirrors_are_a_geometric_series_t44(void **state)
{
    size_t off = 0;
    PictureSettings settings = picture_settings();
    settings.render.statistics = true;
    const size_t pixels = (size_t)settings.render.width * settings.render.height;
    Scene scene = parallel_mirrors();
    for (uint32_t level = 0; level <= 64; level += tier() == 0 ? 16 : 1) {
        char details[32];
        Framebuffer picture;
        RenderProgress progress;
        settings.render.max_level = level;
        picture_draw_counted(&picture, *state, &scene, &settings, &progress);
        const uint64_t reflected = level > 0 ? pixels * (level - 1) : 0;
        const bool bounded = progress.tallies[TALLY_REFLECTED_RAYS] == reflected &&
                             progress.tallies[TALLY_SHADED_POINTS] == pixels * level;
        snprintf(details, sizeof details, "levels=%u", level);
        off += report_case("T-44", details, pixels, count_off(&picture, &scene, level) + !bounded);
        framebuffer_free(&picture);
    }
    scene_free(&scene);
    assert_int_equal(off, 0);
}

static void turn(Mesh *mesh, const Vec3 axes[3])
{
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
        double *p = mesh->positions[vertex];
        const Vec3 turned = rotated(axes, vec3(p[0], p[1], p[2]));
        p[0] = turned.x;
        p[1] = turned.y;
        p[2] = turned.z;
    }
}

#define BOUNCES 64

// Makes the inside of a shape its front.
static Mesh inside_out(Mesh mesh)
{
    for (size_t i = 0; i < mesh.triangle_count; i++) {
        const uint32_t second = mesh.triangles[i][1];
        mesh.triangles[i][1] = mesh.triangles[i][2];
        mesh.triangles[i][2] = second;
    }
    return mesh;
}

// Rays from inside a closed perfect mirror; those that escape shade fewer points.
static size_t escapes_from(const Studio *studio, const char *name, Mesh mesh)
{
    Error error = {0};
    char details[48];
    Framebuffer picture;
    RenderProgress progress;
    Scene scene;
    PictureSettings settings = picture_settings();
    settings.render.width = settings.render.height = (uint32_t)tier_size(64, 1000);
    settings.render.max_level = BOUNCES;
    settings.render.statistics = true;
    require(scene_init(&scene, &error), &error);
    shape_add(&scene, mesh, add_mirror(&scene, 1));
    set_view(&scene, vec3(0.1, -0.05, 0.07), vec3(1, 2, 0.5), 100);
    picture_draw_counted(&picture, studio, &scene, &settings, &progress);
    const size_t rays = (size_t)picture.width * picture.height;
    snprintf(details, sizeof details, "mirror=%s bounces=%d", name, BOUNCES);
    const uint64_t points = progress.tallies[TALLY_SHADED_POINTS];
    framebuffer_free(&picture);
    scene_free(&scene);
    return report_case("T-45", details, rays, (size_t)(rays * BOUNCES - points));
}

static void no_ray_escapes_from_a_closed_mirror_t45(void **state)
{
    Random random = {45};
    Vec3 axes[3];
    Mesh turned = shape_cube(1, 3);
    random_rotation(&random, axes);
    turn(&turned, axes);
    size_t escapes = escapes_from(*state, "cube", shape_cube(1, 3));
    escapes += escapes_from(*state, "cube_from_its_front", inside_out(shape_cube(1, 3)));
    escapes +=
        escapes_from(*state, "globe_from_its_front", inside_out(shape_sphere(16, vec3(0, 0, 0))));
    escapes += escapes_from(*state, "turned_cube", turned);
    escapes += escapes_from(*state, "globe", shape_sphere(16, vec3(0, 0, 0)));
    escapes += escapes_from(*state, "bumpy", shape_bumpy(&random, vec3(0, 0, 0)));
    assert_int_equal(escapes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colors_between_parallel_mirrors_are_a_geometric_series_t44),
        cmocka_unit_test(no_ray_escapes_from_a_closed_mirror_t45),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
