// SPDX-License-Identifier: MIT
// Triangles without area must be invisible and open no gap.
#include "support/picture.h"
#include "support/shapes.h"
#include "unit/parsed.h"

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
    const PlySource source = {
        .bytes = flat_triangles, .size = strlen(flat_triangles), .name = "extremes.ply"};
    require(ply_parse(&mesh, &source, &error), &error);
    return mesh;
}

// The first view contains everything. The second view looks from the side at the triangle parallel
// to an axis, so the triangle lies in the middle column. The third view looks along the axis, so
// the triangle lies in the middle pixel.
static const char *const views[] = {"camera 3 -6 2 0 0 0 45\n",
                                    "up 0 1 0\ncamera 1.5 0.125 6 1.5 0.125 -2 40\n",
                                    "camera 1.5 -6 0.5 1.5 0 0.5 40\n"};

EXTREME(triangles_without_area_leave_no_trace_in_a_picture_t11)
{
    const PictureSettings settings = picture_settings(129);
    for (size_t view = 0; view < COUNT(views); view++) {
        // The bounds of the floor and the wall contain the flat triangles.
        Scene scene = parsed_format("light -3 -4 5 1\n%s", views[view]);
        shape_add(&scene, shape_plane(vec3(-2, -2, -2), vec3(4, 0, 0), vec3(0, 4, 0), 8), 1);
        shape_add(&scene, shape_plane(vec3(-2, 2, -2), vec3(4, 0, 0), vec3(0, 0, 4), 8), 3);
        FREED_BY(framebuffer_free) Framebuffer without = picture_draw(*state, &scene, &settings);
        shape_add(&scene, flat_mesh(), 2);
        assert_int_equal(picture_count_faults(&without), 0);
        outcome_report(
            picture_compare("T-11", &without, picture_draw_once(*state, scene, &settings)),
            "view=%zu", view);
    }
}

FIXTURES(picture_setup, picture_teardown)
