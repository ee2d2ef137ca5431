// SPDX-License-Identifier: MIT
// Tests which parts of a valid file ply.c keeps in the mesh, and which it drops. Tests that a
// written mesh is read back bit for bit, and that the file has the announced size.
#include "mesh/ply_write.h"
#include "unit/ply_builder.h"

static Mesh parse_text(const char *text)
{
    Builder builder = {0};
    put_text(&builder, "%s", text);
    return parse_good(&builder);
}

TEST(faces_may_stand_before_the_vertices)
{
    Mesh mesh =
        parse_text(HEAD FACES "element vertex 3\n" XYZ "end_header\n3 2 1 0\n0 0 0 1 0 0 0 1 0");
    assert_triangle(&mesh, 0, 2, 1, 0);
    mesh_free(&mesh);
}

TEST(ascii_positions_keep_double_precision)
{
    FREED_BY(mesh_free)
    Mesh mesh = parse_text(HEAD "element vertex 1\n" XYZ "end_header\n"
                                "1000000.0123456789 -4.9e-324 9.99e29");
    assert_true(mesh.positions[0][0] == 1000000.0123456789);
    assert_true(mesh.positions[0][1] == -0x1p-1074);
    assert_true(mesh.positions[0][2] == 9.99e29);
}

TEST(a_polygon_becomes_a_fan_around_its_first_corner)
{
    FREED_BY(mesh_free)
    Mesh mesh = parse_text(HEAD "element vertex 5\n" XYZ FACES "end_header\n"
                                "0 0 0 2 0 0 3 1 0 2 2 0 0 2 0\n5 4 0 1 2 3\n");
    assert_int_equal(mesh.triangle_count, 3);
    assert_triangle(&mesh, 0, 4, 0, 1);
    assert_triangle(&mesh, 1, 4, 1, 2);
    assert_triangle(&mesh, 2, 4, 2, 3);
}

#define STRIPS "element tristrips 1\nproperty list int int vertex_indices\n"
#define SQUARE "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0\n"

TEST(the_triangles_of_a_strip_have_one_winding_and_minus_one_begins_a_strip)
{
    FREED_BY(mesh_free)
    Mesh mesh = parse_text(HEAD "element vertex 6\n" XYZ STRIPS "end_header\n" SQUARE
                                "14 0 1 2 3 4 -1 -1 5 4 -1 2 3 4 5\n");
    assert_int_equal(mesh.triangle_count, 5);
    assert_triangle(&mesh, 0, 0, 1, 2);
    assert_triangle(&mesh, 1, 2, 1, 3);
    assert_triangle(&mesh, 2, 2, 3, 4);
    assert_triangle(&mesh, 3, 2, 3, 4);
    assert_triangle(&mesh, 4, 4, 3, 5);
}

TEST(strips_in_binary_files_follow_the_faces_and_drop_repeated_corners)
{
    Builder builder = {0};
    static const unsigned char list[] = {6, 0, 1, 2, 2, 3, 255};
    put_text(&builder, "ply\nformat binary_little_endian 1.0\nelement vertex 4\n");
    put_text(&builder, "property char x\nproperty char y\nproperty char z\nelement face 1\n");
    put_text(&builder, "property list uchar uchar vertex_index\nelement tristrips 1\n");
    put_text(&builder, "property list uchar char vertex_index\nend_header\n");
    memcpy(builder.bytes + builder.size, "\0\0\0\1\0\0\0\1\0\1\1\0\3\0\1\3", 16);
    memcpy(builder.bytes + builder.size + 16, list, sizeof list);
    builder.size += 16 + sizeof list;
    FREED_BY(mesh_free) Mesh mesh = parse_good(&builder);
    assert_int_equal(mesh.triangle_count, 2);
    assert_triangle(&mesh, 0, 0, 1, 3);
    assert_triangle(&mesh, 1, 0, 1, 2);
    assert_int_equal(mesh.dropped.count, 2); // 2 1 2 and 2 2 3 of the strip 0 1 2 2 3
}

TEST(triangles_with_equal_corner_positions_are_dropped)
{
    FREED_BY(mesh_free)
    Mesh mesh = parse_text(HEAD "element vertex 5\n" XYZ
                                "element face 7\nproperty list uchar int vertex_indices\nend_header"
                                "\n0 0 0 1 0 0 0 1 0 1.0 -0 0e5 0 0 1\n3 0 1 3\n3 0 1 2\n3 3 0 1\n"
                                "3 1 2 3\n3 2 2 0\n4 2 0 1 3\n3 0 1 4\n");
    assert_int_equal(mesh.dropped.count, 5);
    assert_int_equal(mesh.triangle_count, 3);
    assert_triangle(&mesh, 0, 0, 1, 2);
    assert_triangle(&mesh, 1, 2, 0, 1);
    assert_triangle(&mesh, 2, 0, 1, 4);
}

TEST(normals_are_used_only_when_all_three_are_there)
{
    Mesh mesh = parse_text(HEAD "element vertex 1\n" XYZ "property float nx\nproperty float nz\n"
                                "end_header\n1 2 3 nan inf\n");
    assert_null(mesh.normals);
    assert_true(mesh.positions[0][2] == 3);
    mesh_free(&mesh);
    mesh = parse_text(HEAD "element vertex 1\nproperty float nz\nproperty float nx\n" XYZ
                           "property float ny\nend_header\n1e-50 5 1 2 3 6\n");
    assert_true(mesh.normals[0][0] == 5 && mesh.normals[0][1] == 6 && mesh.normals[0][2] == 0);
    mesh_free(&mesh);
}

TEST(the_last_value_of_an_ascii_file_needs_no_blank_behind_it)
{
    FREED_BY(mesh_free) Mesh mesh = parse_text(HEAD "element vertex 1\n" XYZ "end_header\n1 2 3");
    assert_true(mesh.positions[0][2] == 3);
}

TEST(a_file_without_elements_is_an_empty_mesh)
{
    const Mesh empty = {0};
    Mesh mesh = parse_text(HEAD "end_header");
    assert_memory_equal(&mesh, &empty, sizeof empty);
    mesh = parse_text(BINARY "element vertex 0\nelement face 0\n"
                             "element a 9223372036854775807\nend_header\ntrailing");
    assert_memory_equal(&mesh, &empty, sizeof empty);
}

static double floats[4][3] = {
    {0, -0.0, 1}, {0x1.fffffep10, 0x1p-149, -3}, {0x1p99, 0, 0}, {0, 1, 0}};
static double doubles[4][3] = {{0.1, 0, 1}, {1, 0x1p-1000, -3}, {9e29, 0, 0}, {0, 1, 0}};
static float normals[4][3] = {{0, 0, 0}, {1, -0.0f, 0}, {0, 3e38f, 0x1p-149f}, {0, 0, 1}};
static float bytes_of_colors[4][3] = {{0, 1, 0.2f}, {1 / 255.0f, 0, 0}, {1, 1, 1}, {0, 0, 0}};
static float float_colors[4][3] = {{0, 1, 0.3f}, {0x1p-149f, 0, 0}, {1, 1, 1}, {0, 0, 0}};
static uint32_t triangles[2][3] = {{0, 1, 2}, {2, 1, 3}};

static void expect_same(Mesh mesh, size_t vertex_size)
{
    char *bytes;
    size_t size;
    FILE *stream = open_memstream(&bytes, &size);
    assert_non_null(stream);
    assert_true(ply_write(&mesh, stream));
    assert_int_equal(fclose(stream), 0);
    assert_int_equal(size, ply_write_size(&mesh));
    const char *body = (const char *)memmem(bytes, size, "end_header\n", 11) + 11;
    assert_int_equal(size - (size_t)(body - bytes),
                     mesh.vertex_count * vertex_size + 13 * mesh.triangle_count);

    FREED_BY(mesh_free) Mesh again;
    Error error = {0};
    if (!ply_parse(&again, &(PlySource){.bytes = bytes, .size = size, .name = "t.ply"}, &error))
        fail_msg("%s", error.text);
    assert_int_equal(again.vertex_count, mesh.vertex_count);
    assert_int_equal(again.triangle_count, mesh.triangle_count);
    if (mesh.vertex_count > 0)
        assert_memory_equal(again.positions, mesh.positions, 4 * sizeof *mesh.positions);
    if (mesh.triangle_count > 0)
        assert_memory_equal(again.triangles, mesh.triangles, 2 * sizeof *mesh.triangles);
    assert_int_equal(again.normals != NULL, mesh.normals != NULL);
    if (mesh.normals != NULL)
        assert_memory_equal(again.normals, mesh.normals, 4 * sizeof *mesh.normals);
    assert_int_equal(again.colors != NULL, mesh.colors != NULL);
    if (mesh.colors != NULL)
        assert_memory_equal(again.colors, mesh.colors, 4 * sizeof *mesh.colors);
    free(bytes);
}

#define MESH .triangles = triangles, .vertex_count = 4, .triangle_count = 2

TEST(colors_come_back_in_bytes_where_they_suffice)
{
    expect_same((Mesh){MESH, .positions = floats, .colors = bytes_of_colors}, 15);
    expect_same((Mesh){MESH, .positions = floats, .colors = float_colors}, 24);
    expect_same((Mesh){MESH, .positions = doubles, .normals = normals, .colors = float_colors}, 48);
}

TEST(a_mesh_comes_back_in_floats_where_they_suffice_and_with_its_normals)
{
    expect_same((Mesh){MESH, .positions = floats}, 12);
    expect_same((Mesh){MESH, .positions = doubles}, 24);
    expect_same((Mesh){MESH, .positions = doubles, .normals = normals}, 36);
    expect_same((Mesh){0}, 0);
}

TEST(a_full_disk_is_reported)
{
    const Mesh mesh = {MESH, .positions = doubles};
    FILE *full = fopen("/dev/full", "wb");
    setvbuf(full, NULL, _IONBF, 0);
    assert_false(ply_write(&mesh, full));
    fclose(full);
}
