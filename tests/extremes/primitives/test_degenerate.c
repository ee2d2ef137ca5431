// SPDX-License-Identifier: MIT
// Triangles without area, and triangles in the same place. They must neither show nor open a gap,
// and the picture must not depend on the tree.
#include "support/closed.h"
#include "support/picture.h"
#include "support/scene_text.h"

#include "mesh/ply.h"

#include <string.h>

// The first four triangles have two or three equal corners, by index or position. The last three
// have corners on a line: exactly, within one unit in the last place, and along an axis.
static const char flat_triangles[] = "ply\nformat ascii 1.0\nelement vertex 8\n"
                                     "property double x\nproperty double y\nproperty double z\n"
                                     "element face 7\nproperty list uchar int vertex_indices\n"
                                     "end_header\n"
                                     "0 0 0\n0 0 0\n1 0.5 0.25\n-1 -0.5 -0.25\n"
                                     "1 0.50000006 0.25\n1.5 -1 0.5\n1.5 1 0.5\n1.5 0.3 0.5\n"
                                     "3 0 0 0\n3 0 1 0\n3 0 1 2\n3 2 2 3\n"
                                     "3 3 0 2\n3 3 0 4\n3 5 7 6\n";

static Mesh flat_mesh(void)
{
    Mesh mesh;
    Error error = {0};
    require(ply_parse(&mesh, flat_triangles, strlen(flat_triangles), "extremes.ply", &error),
            &error);
    return mesh;
}

static void triangles_with_equal_corners_are_dropped_and_counted_t11(void **state)
{
    (void)state;
    Mesh mesh = flat_mesh();
    const bool right = mesh.dropped_count == 4 && mesh.triangle_count == 3;
    mesh_free(&mesh);
    outcome_report(outcome_of("T-11", 7, !right), "counted");
}

// The first view contains everything. The middle column of the second view and the middle pixel of
// the third look straight at and along the triangle that is parallel to an axis.
static const char *const views[] = {"camera 3 -6 2 0 0 0 45\n",
                                    "up 0 1 0\ncamera 1.5 0.125 6 1.5 0.125 -2 40\n",
                                    "camera 1.5 -6 0.5 1.5 0 0.5 40\n"};

static void triangles_without_area_leave_no_trace_in_a_picture_t11(void **state)
{
    const PictureSettings settings = picture_settings(129);
    for (size_t view = 0; view < COUNT(views); view++) {
        // A floor and a wall, whose bounds contain the flat triangles.
        Scene scene = scene_text_parse("light -3 -4 5 1\n%s", views[view]);
        shape_add(&scene, shape_plane(vec3(-2, -2, -2), vec3(4, 0, 0), vec3(0, 4, 0), 8), 1);
        shape_add(&scene, shape_plane(vec3(-2, 2, -2), vec3(4, 0, 0), vec3(0, 0, 4), 8), 3);
        Framebuffer without = picture_draw(*state, &scene, &settings);
        shape_add(&scene, flat_mesh(), 2);
        assert_int_equal(picture_count_faults(&without), 0);
        outcome_report(
            picture_compare("T-11", &without, picture_draw_once(*state, scene, &settings)),
            "view=%zu", view);
        framebuffer_free(&without);
    }
}

// Far from the origin, rounding gives many triangles of a sphere two equal corners.
static void judge_crushed_sphere(RayBatch *batch, int exponent, uint32_t rings)
{
    char label[64];
    Mesh sphere = shape_sphere(rings, shape_center(exponent));
    mesh_drop_triangles(&sphere);
    snprintf(label, sizeof label, "rings=%u dropped=%zu ", rings, sphere.dropped_count);
    const ClosedTest test = {"T-11", label, 1100, CLOSED_AIM(AIM_EDGES) | CLOSED_AIM(AIM_VERTICES),
                             tier_size(10000, 150000)};
    closed_judge(batch, shape_scene(sphere), exponent, &test);
}

static void dropping_triangles_opens_no_seam_t11(void **state)
{
    RayBatch batch;
    (void)state;
    ray_batch_open(&batch, NULL, NULL);
    for (int exponent = 19; exponent <= 23; exponent++)
        judge_crushed_sphere(&batch, exponent, 20);
    for (int exponent = 19; exponent <= 21; exponent++)
        judge_crushed_sphere(&batch, exponent, 60);
    ray_batch_close(&batch);
}

// Draws two equal cubes. Each pixel must show the background or the color of the first cube.
static void judge_coincident(const Studio *studio, TreeKind tree, bool green_first)
{
    static const float background[3] = {1, 0, 0}, green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
    PictureSettings settings = picture_settings(256);
    Scene scene = scene_text_parse("camera 3 -6 2.5 0 0 0 30\nbackground 1 0 0\n"
                                   "define first silhouette diffuse 0 %d %d\n"
                                   "define second silhouette diffuse 0 %d %d\n",
                                   green_first, !green_first, !green_first, green_first);
    shape_add(&scene, shape_cube(1, 9), COURSE_MATERIALS);
    shape_add(&scene, shape_cube(1, 9), COURSE_MATERIALS + 1);
    settings.tree = tree;
    Framebuffer picture = picture_draw_once(studio, scene, &settings);
    const size_t pixels = picture_pixels(&picture);
    const size_t empty = pixels - picture_count_other(&picture, background);
    const size_t first = pixels - picture_count_other(&picture, green_first ? green : blue);
    outcome_report(outcome_of("T-13", pixels, pixels - empty - first), "first=%s tree=%s",
                   green_first ? "green" : "blue", tree_names[tree]);
    assert_in_range(first, 10000, 60000);
    framebuffer_free(&picture);
}

static void of_coincident_triangles_the_first_in_the_file_shows_in_every_tree_t13(void **state)
{
    for (TreeKind tree = TREE_SAH; tree < TREE_KINDS; tree++) {
        judge_coincident(*state, tree, true);
        judge_coincident(*state, tree, false);
    }
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(triangles_with_equal_corners_are_dropped_and_counted_t11),
          EXTREME(triangles_without_area_leave_no_trace_in_a_picture_t11),
          EXTREME(dropping_triangles_opens_no_seam_t11),
          EXTREME(of_coincident_triangles_the_first_in_the_file_shows_in_every_tree_t13))
