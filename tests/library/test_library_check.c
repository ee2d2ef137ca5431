// SPDX-License-Identifier: MIT
// Tests clrt_check with meshes made of arrays. test_python compares the library's checks of files
// with the program's checks.
#include "library/faults.h"
#include "library/renderer.h"

#include <string.h>

// A tetrahedron, a triangle with two equal corners, and an unused vertex.
static const double corners[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}};
static const uint32_t sides[5][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {1, 2, 2}};

static ClrtScene *scene;

static ClrtCheck *check_sides(size_t first, size_t count)
{
    const ClrtMesh mesh = {.size = sizeof mesh,
                           .positions = corners[0],
                           .triangles = sides[first],
                           .vertex_count = 5,
                           .triangle_count = count};
    scene = clrt_scene_create(NULL);
    assert_true(clrt_scene_add_mesh(scene, &mesh, NULL));
    ClrtCheck *check = clrt_check(renderer, scene, NULL);
    assert_non_null(check);
    return check;
}

static void free_all(ClrtCheck *check)
{
    clrt_scene_free(scene);
    clrt_check_free(check);
}

static ClrtCheckInfo info_of(const ClrtCheck *check)
{
    ClrtCheckInfo info = {.size = sizeof info};
    assert_true(clrt_check_get_info(check, &info, NULL));
    return info;
}

static ClrtCheckedMesh mesh_of(const ClrtCheck *check)
{
    ClrtCheckedMesh mesh = {.size = sizeof mesh};
    assert_true(clrt_check_get_mesh(check, 0, &mesh, NULL));
    return mesh;
}

// Returns the finding of this kind, or one with the count 0.
static ClrtFinding find(const ClrtCheck *check, const char *kind)
{
    ClrtFinding finding = {.size = sizeof finding};
    for (uint32_t i = 0; clrt_check_get_finding(check, i, &finding, NULL); i++)
        if (strcmp(finding.kind, kind) == 0)
            return finding;
    return (ClrtFinding){0};
}

TEST(a_closed_mesh_has_no_leaks)
{
    ClrtCheck *check = check_sides(0, 4);
    const ClrtCheckedMesh mesh = mesh_of(check);
    assert_true(info_of(check).fine);
    assert_true(mesh.closed && !mesh.inside_out);
    assert_int_equal(mesh.triangle_count, 4);
    assert_int_equal(mesh.edge_count, 6);
    assert_int_equal(mesh.unused_vertices, 1);
    assert_int_equal(mesh.aim_count, 10);
    assert_true(mesh.ray_count >= 10);
    assert_int_equal(mesh.leaks, 0);
    assert_true(mesh.shortest_edge == 1);
    assert_string_equal(mesh.path, "");
    free_all(check);
}

TEST(findings_name_triangles)
{
    ClrtCheck *check = check_sides(1, 4);
    const ClrtFinding equal = find(check, "equal_corners"), open = find(check, "open_edges");
    assert_false(info_of(check).fine);
    assert_false(mesh_of(check).closed);
    assert_true(equal.fails && !open.fails);
    assert_int_equal(equal.count, 1);
    assert_int_equal(equal.first, 3);
    assert_int_equal(equal.mesh, 0);
    assert_int_equal(open.count, 3);
    assert_string_equal(equal.text, "1 triangle with two equal corners, left out: triangle 3");
    assert_int_equal(find(check, "no_lights").count, 0);
    free_all(check);
}

TEST(eyes_inside_meshes_without_files_are_found)
{
    const ClrtCamera camera = {
        .size = sizeof camera, .eye = {0.1, 0.1, 0.1}, .look_at = {1, 0, 0}, .fov_degrees = 45};
    ClrtCheck *check = check_sides(0, 4);
    clrt_check_free(check);
    assert_true(clrt_scene_add_camera(scene, &camera, NULL));
    check = clrt_check(renderer, scene, NULL);
    const ClrtFinding eye = find(check, "eye_inside");
    assert_int_equal(eye.mesh, CLRT_NOTHING);
    assert_non_null(strstr(eye.text, "view 1 in a mesh"));
    free_all(check);
}

TEST(wrong_numbers_are_faults)
{
    ClrtFinding finding = {.size = sizeof finding};
    ClrtCheckedMesh mesh = {.size = sizeof mesh};
    ClrtCheck *check = check_sides(0, 4);
    REFUSES(clrt_check_get_mesh(check, 1, &mesh, &error), "no mesh 1");
    REFUSES(clrt_check_get_finding(check, 99, &finding, &error), "no finding 99");
    REFUSES(clrt_check_get_info(NULL, NULL, &error), "the check");
    REFUSES(clrt_check(NULL, scene, &error) != NULL, "the renderer");
    free_all(check);
}
