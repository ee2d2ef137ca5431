// SPDX-License-Identifier: MIT
// Many reflections. Between parallel mirrors, the color is a geometric series. No ray leaves a
// closed mirror.
#include "support/picture.h"
#include "support/random.h"
#include "support/scene_text.h"
#include "support/shapes.h"

// Mirrors show only their own color and reflections.
#define MIRROR "define mirror silhouette diffuse 0.5 0.75 0.2 reflectivity "
static const float mirror_color[3] = {0.5f, 0.75f, 0.2f}, background[3] = {0.25f, 1, 0.5f};

// Returns two mirrors at x = -1 and x = 1. The eye is between them.
static Scene parallel_mirrors(void)
{
    Scene scene = scene_text_parse(MIRROR "0.25\nbackground 0.25 1 0.5\n"
                                          "camera 0 0 0 1 0.001 0.002 5\n");
    for (int x = -1; x <= 1; x += 2)
        shape_add(&scene, shape_plane(vec3(x, -20, -20), vec3(0, 40, 0), vec3(0, 0, 40), 1),
                  COURSE_MATERIALS);
    return scene;
}

// Returns (1 - r) c (1 + r + ... + r^(level - 1)) + r^level b for r = 0.25.
static double mirrored_color(double color, double beyond, uint32_t level)
{
    double sum = 0, weight = 1;
    for (uint32_t i = 0; i < level; i++) {
        sum += weight * 0.75 * color;
        weight *= 0.25;
    }
    return sum + weight * beyond;
}

// Returns how many values differ from the series by more than 4 units in the last place a level.
static size_t count_wrong(const Framebuffer *picture, uint32_t level)
{
    size_t wrong = 0;
    const double allowed = 4 * 0x1p-24 * (level > 0 ? level : 1);
    for (size_t i = 0; i < 3 * picture_pixels(picture); i++) {
        const double expected =
            mirrored_color((double)mirror_color[i % 3], (double)background[i % 3], level);
        wrong += !(fabs((double)(*picture->pixels)[i] - expected) <= allowed * expected);
    }
    return wrong;
}

static void colors_between_parallel_mirrors_are_a_geometric_series_t44(void **state)
{
    PictureSettings settings = picture_settings(64);
    uint32_t *level = &settings.render.max_level;
    settings.render.statistics = true;
    Scene scene = parallel_mirrors();
    for (*level = 0; *level <= 64; *level += tier() == 0 ? 16 : 1) {
        RenderProgress progress;
        Framebuffer picture = picture_draw_counted(*state, &scene, &settings, &progress);
        const size_t pixels = picture_pixels(&picture);
        const uint64_t reflected = *level > 0 ? pixels * (*level - 1) : 0;
        const bool right_counts = progress.tallies[TALLY_REFLECTED_RAYS] == reflected &&
                                  progress.tallies[TALLY_SHADED_POINTS] == pixels * *level;
        outcome_report(outcome_of("T-44", pixels, count_wrong(&picture, *level) + !right_counts),
                       "levels=%u", *level);
        framebuffer_free(&picture);
    }
    scene_free(&scene);
}

#define BOUNCES 64

// Draws the inside of a closed perfect mirror. Rays that leave it shade fewer points.
static void judge_escapes(const Studio *studio, const char *name, Mesh mesh, bool from_front)
{
    RenderProgress progress;
    PictureSettings settings = picture_settings((uint32_t)tier_size(64, 1000));
    settings.render.max_level = BOUNCES;
    settings.render.statistics = true;
    Scene scene = scene_text_parse(MIRROR "1\ncamera 0.1 -0.05 0.07 1 2 0.5 100\n");
    if (from_front)
        shape_flip(&mesh);
    shape_add(&scene, mesh, COURSE_MATERIALS);
    Framebuffer picture = picture_draw_counted(studio, &scene, &settings, &progress);
    const size_t rays = picture_pixels(&picture);
    const uint64_t lost = rays * BOUNCES - progress.tallies[TALLY_SHADED_POINTS];
    outcome_report(outcome_of("T-45", rays, (size_t)lost), "mirror=%s bounces=%d from_front=%d",
                   name, BOUNCES, from_front);
    framebuffer_free(&picture);
    scene_free(&scene);
}

static void no_ray_escapes_from_a_closed_mirror_t45(void **state)
{
    Random random = {45};
    Vec3 axes[3];
    Mesh turned = shape_cube(1, 3);
    random_rotation(&random, axes);
    for (size_t vertex = 0; vertex < turned.vertex_count; vertex++)
        shape_set_vertex(&turned, vertex, rotated(axes, shape_vertex(&turned, vertex)));
    judge_escapes(*state, "turned_cube", turned, false);
    judge_escapes(*state, "bumpy", shape_bumpy(&random, vec3(0, 0, 0)), false);
    for (int from_front = 0; from_front < 2; from_front++) {
        judge_escapes(*state, "cube", shape_cube(1, 3), from_front == 1);
        judge_escapes(*state, "globe", shape_sphere(16, vec3(0, 0, 0)), from_front == 1);
    }
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(colors_between_parallel_mirrors_are_a_geometric_series_t44),
          EXTREME(no_ray_escapes_from_a_closed_mirror_t45))
