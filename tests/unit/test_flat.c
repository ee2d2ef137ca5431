// SPDX-License-Identifier: MIT
// Tests the arrays that the device reads.
#include "accel/flat.h"
#include "accel/traits.h"
#include "unit/parsed.h"

#include <string.h>

// A flattened scene and its sources.
typedef struct {
    Scene scene;
    Triangles triangles;
    Bvh bvh;
    FlatScene flat;
} Flattened;

static Flattened flattened_as(const char *text, bool uses_bvh, NodeLayout layout)
{
    Flattened all = {.scene = parsed(text)};
    Error error = {0};
    const Normalization frame = normalization_of(&all.scene);
    const BvhSettings settings = {BVH_SAH, flat_leaves(layout)};
    const FlatSource source = {.scene = &all.scene,
                               .triangles = &all.triangles,
                               .bvh = &all.bvh,
                               .normalization = &frame,
                               .layout = layout,
                               .has_tree = true};
    const bool ok = triangles_make(&all.triangles, &all.scene, &frame, NULL, &error) &&
                    (!uses_bvh || bvh_build(&all.bvh, &all.triangles, &settings, NULL, &error)) &&
                    flat_make(&all.flat, &source, &error);
    if (!ok)
        fail_msg("%s", error.text);
    return all;
}

static Flattened flattened(const char *text, bool uses_bvh)
{
    return flattened_as(text, uses_bvh, NODES_PAIR);
}

static void release(Flattened *all)
{
    flat_free(&all->flat);
    bvh_free(&all->bvh);
    triangles_free(&all->triangles);
    scene_free(&all->scene);
}

TEST(ids_number_spheres_first_and_triangles_in_file_order)
{
    Flattened all =
        flattened("ply_file cube.ply\nsphere 0 0 0 1\nply_file cone.ply\nsphere 0 0 0 2", true);
    const uint32_t count = (uint32_t)all.triangles.count;
    assert_int_equal(all.flat.sphere_count, 2);
    assert_int_equal(all.flat.triangle_count, count);
    for (uint32_t place = 0; place < count; place++) {
        const TriangleData *triangle = &all.flat.triangles[place];
        const uint32_t number = triangle->id - 2;
        assert_int_equal(number, all.bvh.order[place]);
        const CornerOrder *order = triangles_order(&all.triangles, number);
        assert_memory_equal(triangle->b, triangles_corner(&all.triangles, number, order->places[1]),
                            sizeof triangle->b);
        assert_int_equal((triangle->material & TRIANGLE_REVERSED) != 0, order->reversed);
    }
    release(&all);
}

// Tests a triangle with its corners in all six orders. The first three orders have the same
// orientation. Two of the corners differ only in the last coordinate.
TEST(corners_are_stored_in_one_order_whatever_their_order_in_the_file)
{
    static const float points[3][3] = {{1, 2, 5}, {1, 2, 4}, {1, -3, 6}};
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                     {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int i = 0; i < 6; i++) {
        const int *file = orders[i];
        const CornerOrder *order =
            &corner_orders[corner_order(points[file[0]], points[file[1]], points[file[2]])];
        for (int corner = 0; corner < 3; corner++)
            assert_int_equal(file[order->places[corner]], 2 - corner);
        assert_int_equal(order->reversed, i < 3); // 2, 1, 0 has the opposite orientation of 0, 1, 2
    }
}

TEST(zero_has_one_sign)
{
    static const double positions[3][3] = {{-1, -1, -1}, {1, 1, 1}, {1, -1, -0.0}};
    FREED_BY(triangles_free) Triangles triangles;
    Error error = {0};
    FREED_BY(release) Flattened all = flattened("ply_file ../tests/unit/zero_normal.ply", true);
    memcpy(all.scene.objects.data[0].mesh.positions, positions, sizeof positions);
    const Normalization frame = normalization_of(&all.scene);
    assert_true(triangles_make(&triangles, &all.scene, &frame, NULL, &error));
    assert_true(triangles.points[2][2] == 0 && !signbit(triangles.points[2][2]));
}

TEST(sphere_parts_add_up_to_the_double)
{
    FREED_BY(release) Flattened all = flattened("ply_file cube.ply\nsphere 0.1 0.2 0.3 0.7", true);
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
}

TEST(a_scene_without_triangles_has_no_tree_and_no_arrays_for_them)
{
    FREED_BY(release) Flattened all = flattened("sphere 0 0 0 1", true);
    assert_int_equal(all.flat.node_count, 0);
    assert_int_equal(all.flat.triangle_count, 0);
    assert_int_equal(all.flat.normals_count, 0);
}

TEST(flat_objects_upload_no_normals)
{
    FREED_BY(release) Flattened all = flattened("normals flat\nply_file cube.ply", true);
    assert_int_equal(all.flat.normals_count, 0);
    assert_true(all.flat.triangles[0].shading == NOTHING);
}

TEST(a_lone_leaf_gets_a_node_with_one_child)
{
    FREED_BY(release) Flattened all = flattened("ply_file cube.ply", true);
    Bvh leaf = {.node_count = 1, .leaf_count = 1, .nodes = all.bvh.nodes, .order = all.bvh.order};
    all.bvh.nodes[0].count = (uint32_t)all.triangles.count;
    all.bvh.nodes[0].first = 0;
    FREED_BY(flat_free) FlatScene flat = {0};
    Error error = {0};
    const Normalization frame = normalization_of(&all.scene);
    const FlatSource source = {.scene = &all.scene,
                               .triangles = &all.triangles,
                               .bvh = &leaf,
                               .normalization = &frame,
                               .layout = NODES_PAIR};
    assert_true(flat_make(&flat, &source, &error));
    assert_int_equal(flat.node_count, 1);
    assert_int_equal(flat.pairs[0].count[0], all.triangles.count);
    assert_true(flat.pairs[0].planes[0][0][1] > flat.pairs[0].planes[0][1][1]);
}

TEST(a_missing_vertex_normal_becomes_the_faces)
{
    FREED_BY(release) Flattened all = flattened("ply_file ../tests/unit/zero_normal.ply", true);
    assert_int_equal(all.flat.normals_count, 1);
    const CornerOrder *order = triangles_order(&all.triangles, 0);
    const float *of[3] = {NULL}; // normals in the file's order of corners
    for (int corner = 0; corner < 3; corner++)
        of[order->places[corner]] = all.flat.normals[0].normals[corner];
    assert_true(of[1][0] == 0 && of[1][1] == 0 && of[1][2] == (order->reversed ? -1 : 1));
    // The normals that the file contains keep their relative lengths.
    assert_true(of[2][0] == 2 * of[0][0]);
}

// Returns the member `shading` of a triangle, in either layout of nodes.
static uint32_t shading_of(const FlatScene *flat, uint32_t number)
{
    if (flat->layout == NODES_WIDE)
        return flat->looks[number].shading;
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        if (flat->triangles[i].id == flat->sphere_count + number)
            return flat->triangles[i].shading;
    return 0;
}

static void check_colors(const Flattened *all)
{
    const Mesh *mesh = &all->scene.objects.data[1].mesh;
    const uint32_t before = (uint32_t)all->scene.objects.data[0].mesh.triangle_count;
    assert_int_equal(all->flat.colors_count, mesh->triangle_count);
    assert_true(shading_of(&all->flat, 0) == NOTHING);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t word = shading_of(&all->flat, before + i);
        assert_int_equal(word, i | TRIANGLE_COLORED);
        const CornerColors *stored = &all->flat.colors[i];
        const uint8_t *places = triangles_order(&all->triangles, before + i)->places;
        for (int corner = 0; corner < 3; corner++)
            assert_memory_equal(stored->colors[corner],
                                mesh->colors[mesh->triangles[i][places[corner]]],
                                sizeof stored->colors[corner]);
        assert_int_equal(stored->shading, mesh->normals != NULL ? i : NOTHING);
    }
    assert_true(traits_of(&all->flat, false).colors);
}

TEST(colored_triangles_have_the_colors_of_their_corners)
{
    for (int layout = 0; layout < NODE_LAYOUTS; layout++)
        for (int smooth = 0; smooth < 2; smooth++) {
            FREED_BY(release)
            Flattened all = flattened_as(smooth ? "normals flat\nmesh cube.ply\nnormals smooth\n"
                                                  "mesh ../tests/image/painted.ply"
                                                : "normals flat\nmesh cube.ply\n"
                                                  "mesh ../tests/image/painted.ply",
                                         true, (NodeLayout)layout);
            check_colors(&all);
        }
}

TEST(a_selected_material_uploads_no_colors)
{
    FREED_BY(release)
    Flattened all = flattened("material 1\nmesh ../tests/image/painted.ply", true);
    assert_int_equal(all.flat.colors_count, 0);
    assert_false(traits_of(&all.flat, false).colors);
}

// The scenes below have one sphere, so an id without marks is the triangle's number plus 1.
#define NUMBER_OF(id) (((id) & ~TRIANGLE_MARKS) - 1)

TEST(a_leaf_too_large_for_a_block_becomes_several)
{
    FREED_BY(release)
    Flattened all = flattened_as("sphere 0 0 0 1\nply_file cone.ply", true, NODES_WIDE);
    const Bvh leaf = {
        .node_count = 1, .leaf_count = 1, .nodes = all.bvh.nodes, .order = all.bvh.order};
    all.bvh.nodes[0].count = (uint32_t)all.triangles.count;
    all.bvh.nodes[0].first = 0;
    const Normalization frame = normalization_of(&all.scene);
    const FlatSource source = {.scene = &all.scene,
                               .triangles = &all.triangles,
                               .bvh = &leaf,
                               .normalization = &frame,
                               .layout = NODES_WIDE};
    Error error = {0};
    flat_free(&all.flat);
    assert_true(flat_make(&all.flat, &source, &error));
    assert_int_equal(all.flat.block_count, (all.triangles.count + 7) / 8);
}

TEST(without_a_tree_blocks_hold_the_triangles_in_file_order)
{
    FREED_BY(release)
    Flattened all = flattened_as("sphere 0 0 0 1\nply_file cone.ply", false, NODES_WIDE);
    assert_int_equal(all.flat.node_count, 0);
    assert_int_equal(all.flat.block_count, (all.triangles.count + 7) / 8);
    for (uint32_t i = 0; i < all.triangles.count; i++)
        assert_int_equal(NUMBER_OF(all.flat.blocks[i / 8].id[i % 8]), i);
}

TEST(blocks_mark_two_sided_triangles_and_looks_do_not)
{
    FREED_BY(release)
    Flattened all = flattened_as("material 1\nsphere 0 0 0 1\nply_file tetrahedron.ply\n"
                                 "sides two\nmaterial 2\nnormals flat\nply_file tetrahedron.ply",
                                 true, NODES_WIDE);
    const uint32_t half = (uint32_t)all.triangles.count / 2;
    for (uint32_t block = 0; block < all.flat.block_count; block++)
        for (int i = 0; i < WIDE; i++) {
            const uint32_t id = all.flat.blocks[block].id[i];
            if (id != NOTHING)
                assert_true((NUMBER_OF(id) >= half) == ((id & TRIANGLE_TWO_SIDED) != 0));
        }
    assert_int_equal(all.flat.looks[0].material, 1);
    assert_int_equal(all.flat.looks[half].material, 2);
    assert_true(all.flat.looks[half].shading == NOTHING);
}
