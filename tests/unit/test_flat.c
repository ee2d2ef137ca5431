// SPDX-License-Identifier: MIT
// The arrays the device reads.
#include "accel/flat.h"
#include "scene/scn.h"

#include "unit/cmocka_all.h"

#include <string.h>

// Keeps what a flattened scene was made from.
typedef struct {
    Scene scene;
    Triangles triangles;
    Bvh bvh;
    FlatScene flat;
} Flattened;

static Flattened flattened(const char *text, bool uses_bvh)
{
    Flattened all = {0};
    Error error = {0};
    bool ok =
        scn_parse(&all.scene, text, strlen(text), CLRT_SOURCE_FOLDER "/scenes/inline.scn", &error);
    const Normalization frame = normalization_of(&all.scene);
    ok = ok && triangles_make(&all.triangles, &all.scene, &frame, &error) &&
         (!uses_bvh || bvh_build(&all.bvh, &all.triangles, BVH_SAH, &error)) &&
         flat_make(&all.flat, &all.scene, &all.triangles, &all.bvh, &error);
    if (!ok)
        fail_msg("%s", error.text);
    return all;
}

static void release(Flattened *all)
{
    flat_free(&all->flat);
    bvh_free(&all->bvh);
    triangles_free(&all->triangles);
    scene_free(&all->scene);
}

static void ids_number_spheres_first_and_triangles_in_file_order(void **state)
{
    (void)state;
    Flattened all =
        flattened("ply_file cube.ply\nsphere 0 0 0 1\nply_file cone.ply\nsphere 0 0 0 2", true);
    const uint32_t count = (uint32_t)all.triangles.count;
    assert_int_equal(all.flat.sphere_count, 2);
    assert_int_equal(all.flat.triangle_count, count);
    for (uint32_t place = 0; place < count; place++) {
        const TriangleData *triangle = &all.flat.triangles[place];
        const uint32_t number = triangle->id - 2;
        assert_int_equal(number, all.bvh.order[place]);
        assert_memory_equal(triangle->b, all.triangles.corners[number][1], sizeof triangle->b);
    }
    release(&all);
}

static void sphere_parts_add_up_to_the_double(void **state)
{
    (void)state;
    Flattened all = flattened("ply_file cube.ply\nsphere 0.1 0.2 0.3 0.7", true);
    const Normalization frame = normalization_of(&all.scene);
    const SphereData *sphere = &all.flat.spheres[0];
    const double radius = (double)sphere->radius + (double)sphere->radius_low;
    assert_true(fabs(radius - 0.7 * frame.scale) < 0x1p-48);
    assert_true(sphere->radius_low != 0);
    const Vec3 center = normalize_point(&frame, vec3(0.1, 0.2, 0.3));
    const double x = (double)sphere->center[0] + (double)sphere->center_low[0];
    const double z = (double)sphere->center[2] + (double)sphere->center_low[2];
    assert_true(fabs(x - center.x) < 0x1p-48 && fabs(z - center.z) < 0x1p-48);
    assert_true(sphere->center_low[0] != 0 && sphere->center_low[2] != 0);
    release(&all);
}

static void a_scene_without_triangles_has_no_tree_and_no_arrays_for_them(void **state)
{
    (void)state;
    Flattened all = flattened("sphere 0 0 0 1", true);
    assert_int_equal(all.flat.node_count, 0);
    assert_int_equal(all.flat.triangle_count, 0);
    assert_int_equal(all.flat.normals_count, 0);
    release(&all);
}

static void flat_objects_upload_no_normals(void **state)
{
    (void)state;
    Flattened all = flattened("normals flat\nply_file cube.ply", true);
    assert_int_equal(all.flat.normals_count, 0);
    assert_true(all.flat.triangles[0].normals == NOTHING);
    release(&all);
}

static void a_lone_leaf_gets_a_node_with_one_child(void **state)
{
    (void)state;
    Flattened all = flattened("ply_file cube.ply", true);
    Bvh leaf = {.node_count = 1, .leaf_count = 1, .nodes = all.bvh.nodes, .order = all.bvh.order};
    all.bvh.nodes[0].count = (uint32_t)all.triangles.count;
    all.bvh.nodes[0].first = 0;
    FlatScene flat = {0};
    Error error = {0};
    assert_true(flat_make(&flat, &all.scene, &all.triangles, &leaf, &error));
    assert_int_equal(flat.node_count, 1);
    assert_int_equal(flat.nodes[0].count[0], all.triangles.count);
    assert_true(flat.nodes[0].planes[0][0][1] > flat.nodes[0].planes[0][1][1]);
    flat_free(&flat);
    release(&all);
}

static void a_missing_vertex_normal_becomes_the_faces(void **state)
{
    (void)state;
    Flattened all = flattened("ply_file ../tests/unit/zero_normal.ply", true);
    assert_int_equal(all.flat.normals_count, 1);
    const float *normal = all.flat.normals[0].normals[1];
    assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] == 1);
    // Given normals keep their own lengths against each other.
    assert_true(all.flat.normals[0].normals[2][0] == 2 * all.flat.normals[0].normals[0][0]);
    release(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ids_number_spheres_first_and_triangles_in_file_order),
        cmocka_unit_test(sphere_parts_add_up_to_the_double),
        cmocka_unit_test(a_scene_without_triangles_has_no_tree_and_no_arrays_for_them),
        cmocka_unit_test(flat_objects_upload_no_normals),
        cmocka_unit_test(a_lone_leaf_gets_a_node_with_one_child),
        cmocka_unit_test(a_missing_vertex_normal_becomes_the_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
