// SPDX-License-Identifier: MIT
// Triangles without an area and triangles on top of each other: neither shows, opens a seam or
// makes a picture depend on the tree.
#include "support/aim.h"
#include "support/check.h"
#include "support/picture.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include "mesh/ply.h"

#include <stdlib.h>
#include <string.h>

// Three or two equal corners, by index or by place; then three corners on a line: exactly, but for
// one unit in the last place of a float, and along an axis.
static const char flat_triangles[] = "ply\n"
                                     "format ascii 1.0\n"
                                     "element vertex 8\n"
                                     "property double x\n"
                                     "property double y\n"
                                     "property double z\n"
                                     "element face 7\n"
                                     "property list uchar int vertex_indices\n"
                                     "end_header\n"
                                     "0 0 0\n"
                                     "0 0 0\n"
                                     "1 0.5 0.25\n"
                                     "-1 -0.5 -0.25\n"
                                     "1 0.50000006 0.25\n"
                                     "1.5 -1 0.5\n"
                                     "1.5 1 0.5\n"
                                     "1.5 0.3 0.5\n"
                                     "3 0 0 0\n"
                                     "3 0 1 0\n"
                                     "3 0 1 2\n"
                                     "3 2 2 3\n"
                                     "3 3 0 2\n"
                                     "3 3 0 4\n"
                                     "3 5 7 6\n";

#define FLAT_DROPPED 4
#define FLAT_KEPT    3

static Mesh parse(const char *bytes, size_t size)
{
    Mesh mesh;
    Error error = {0};
    require(ply_parse(&mesh, bytes, size, "extremes.ply", &error), &error);
    return mesh;
}

static void triangles_with_equal_corners_are_dropped_and_counted_t11(void **state)
{
    (void)state;
    Mesh mesh = parse(flat_triangles, strlen(flat_triangles));
    const bool right = mesh.dropped_count == FLAT_DROPPED && mesh.triangle_count == FLAT_KEPT;
    mesh_free(&mesh);
    report_case("T-11", "counted", FLAT_DROPPED + FLAT_KEPT, !right);
    assert_true(right);
}

// A floor and a wall under one light, whose bounds hold all of the flat triangles.
static Scene room_corner(const Viewpoint *viewpoint)
{
    Error error = {0};
    const Light light = light_white(vec3(-3, -4, 5), 1);
    Scene scene = shape_scene(shape_plane(vec3(-2, -2, -2), vec3(4, 0, 0), vec3(0, 4, 0), 8));
    shape_add(&scene, shape_plane(vec3(-2, 2, -2), vec3(4, 0, 0), vec3(0, 0, 4), 8), 3);
    require(array_push(&scene.viewpoints, *viewpoint, &error) &&
                array_push(&scene.lights, light, &error),
            &error);
    return scene;
}

// The first sees all; the middle column of the second and the very middle of the third look
// straight at and along the triangle that is parallel to an axis.
static const Viewpoint viewpoints[3] = {
    {{3, -6, 2}, {0, 0, 0}, {0, 0, 1}, 45, 0},
    {{1.5, 0.125, 6}, {1.5, 0.125, -2}, {0, 1, 0}, 40, 0},
    {{1.5, -6, 0.5}, {1.5, 0, 0.5}, {0, 0, 1}, 40, 0},
};

static void triangles_without_area_leave_no_trace_in_a_picture_t11(void **state)
{
    size_t failures = 0;
    PictureSettings settings = picture_settings();
    settings.render.width = settings.render.height = 129;
    for (int view = 0; view < 3; view++) {
        char details[32];
        Framebuffer without, with;
        Scene scene = room_corner(&viewpoints[view]);
        picture_draw(&without, *state, &scene, &settings);
        shape_add(&scene, parse(flat_triangles, strlen(flat_triangles)), 2);
        picture_draw(&with, *state, &scene, &settings);
        snprintf(details, sizeof details, "view=%d", view);
        failures +=
            report_case("T-11", details, (size_t)with.width * with.height,
                        picture_count_differences(&without, &with) + picture_count_faults(&with));
        framebuffer_free(&without);
        framebuffer_free(&with);
        scene_free(&scene);
    }
    assert_int_equal(failures, 0);
}

// Writes a mesh as a file and reads it back, which drops triangles.
static Mesh through_file(const Mesh *mesh)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    fprintf(stream,
            "ply\nformat ascii 1.0\nelement vertex %zu\nproperty double x\nproperty double y\n"
            "property double z\nelement face %zu\nproperty list uchar int vertex_indices\n"
            "end_header\n",
            mesh->vertex_count, mesh->triangle_count);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        fprintf(stream, "%.17g %.17g %.17g\n", mesh->positions[i][0], mesh->positions[i][1],
                mesh->positions[i][2]);
    for (size_t i = 0; i < mesh->triangle_count; i++)
        fprintf(stream, "3 %u %u %u\n", mesh->triangles[i][0], mesh->triangles[i][1],
                mesh->triangles[i][2]);
    fclose(stream);
    const Mesh read = parse(text, size);
    free(text);
    return read;
}

// Misses of rays at the edges and vertices of a sphere of that many rings which float has crushed
// and the file reader has cleaned.
static size_t misses_of_crushed_sphere(RayBatch *batch, int exponent, uint32_t rings)
{
    Stage stage;
    Trial trial;
    char details[64];
    const size_t half = tier_size(10000, 150000);
    Random random = {(uint64_t)(1100 + exponent)};
    const Vec3 center = shape_center(exponent);
    Mesh sphere = shape_sphere(rings, center);
    Scene scene = shape_scene(through_file(&sphere));
    const size_t dropped = scene.objects.data[0].mesh.dropped_count;
    TestRay *rays = aim_make_rays(2 * half);
    mesh_free(&sphere);
    stage_make(&stage, &scene, TREE_SAH);
    trial_open(&trial, "T-11", batch, &stage);
    const Room room = room_inside(&stage, center, 1);
    aim_at_edges(rays, half, &room, &stage.triangles, &random);
    aim_at_vertices(rays + half, half, &room, &stage.triangles, &random);
    snprintf(details, sizeof details, "k=%d rings=%u dropped=%zu", exponent, rings, dropped);
    const size_t misses = trial_misses(&trial, details, rays, 2 * half);
    free(rays);
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    return misses;
}

static void dropping_triangles_opens_no_seam_t11(void **state)
{
    (void)state;
    RayBatch batch;
    size_t misses = 0;
    ray_batch_open(&batch, NULL, NULL);
    for (int exponent = 19; exponent <= 23; exponent++)
        misses += misses_of_crushed_sphere(&batch, exponent, 20);
    for (int exponent = 19; exponent <= 21; exponent++)
        misses += misses_of_crushed_sphere(&batch, exponent, 60);
    ray_batch_close(&batch);
    assert_int_equal(misses, 0);
}

static uint32_t add_color(Scene *scene, float red, float green, float blue)
{
    Error error = {0};
    Material color = material_of_shader(SHADER_SILHOUETTE);
    color.diffuse[0] = red;
    color.diffuse[1] = green;
    color.diffuse[2] = blue;
    require(array_push(&scene->materials, color, &error), &error);
    return (uint32_t)scene->materials.count - 1;
}

// Two equal cubes, a green and a blue one: the first in the file is green if the flag says so.
static Scene coincident_cubes(bool green_first)
{
    Error error = {0};
    Scene scene;
    const Viewpoint viewpoint = {{3, -6, 2.5}, {0, 0, 0}, {0, 0, 1}, 30, 0};
    require(scene_init(&scene, &error) && array_push(&scene.viewpoints, viewpoint, &error), &error);
    const uint32_t green = add_color(&scene, 0, 1, 0), blue = add_color(&scene, 0, 0, 1);
    shape_add(&scene, shape_cube(1, 9), green_first ? green : blue);
    shape_add(&scene, shape_cube(1, 9), green_first ? blue : green);
    scene.background = vec3(1, 0, 0);
    return scene;
}

// How many pixels show neither the background nor the cube that comes first; adds those that show
// the cube to *seen.
static size_t wrong_pixels(const Framebuffer *picture, bool green_first, size_t *seen)
{
    size_t wrong = 0;
    for (size_t pixel = 0; pixel < (size_t)picture->width * picture->height; pixel++) {
        const float *color = picture->pixels[pixel];
        const bool background = color[0] == 1 && color[1] == 0 && color[2] == 0;
        const bool first =
            color[0] == 0 && color[green_first ? 1 : 2] == 1 && color[green_first ? 2 : 1] == 0;
        wrong += !background && !first;
        *seen += first;
    }
    return wrong;
}

static size_t draw_coincident(const Studio *studio, TreeKind tree, bool green_first)
{
    char details[64];
    Framebuffer picture;
    size_t seen = 0;
    PictureSettings settings = picture_settings();
    Scene scene = coincident_cubes(green_first);
    settings.tree = tree;
    settings.render.width = settings.render.height = 256;
    picture_draw(&picture, studio, &scene, &settings);
    snprintf(details, sizeof details, "first=%s tree=%s", green_first ? "green" : "blue",
             tree_names[tree]);
    const size_t wrong = report_case("T-13", details, (size_t)picture.width * picture.height,
                                     wrong_pixels(&picture, green_first, &seen));
    assert_in_range(seen, 10000, 60000);
    framebuffer_free(&picture);
    scene_free(&scene);
    return wrong;
}

static void of_coincident_triangles_the_first_in_the_file_shows_in_every_tree_t13(void **state)
{
    size_t wrong = 0;
    for (TreeKind tree = TREE_SAH; tree < TREE_KINDS; tree++) {
        wrong += draw_coincident(*state, tree, true);
        wrong += draw_coincident(*state, tree, false);
    }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_with_equal_corners_are_dropped_and_counted_t11),
        cmocka_unit_test(triangles_without_area_leave_no_trace_in_a_picture_t11),
        cmocka_unit_test(dropping_triangles_opens_no_seam_t11),
        cmocka_unit_test(of_coincident_triangles_the_first_in_the_file_shows_in_every_tree_t13),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
