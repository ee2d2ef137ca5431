// SPDX-License-Identifier: MIT
// Tests that a written mesh is read back bit for bit, and that the file has the announced size.
#include "mesh/ply.h"

#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double floats[4][3] = {
    {0, -0.0, 1}, {0x1.fffffep10, 0x1p-149, -3}, {0x1p99, 0, 0}, {0, 1, 0}};
static double doubles[4][3] = {{0.1, 0, 1}, {1, 0x1p-1000, -3}, {9e29, 0, 0}, {0, 1, 0}};
static float normals[4][3] = {{0, 0, 0}, {1, -0.0f, 0}, {0, 3e38f, 0x1p-149f}, {0, 0, 1}};
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
    assert_int_equal(size - (size_t)(body - bytes), 4 * vertex_size + 2 * 13);

    FREED_BY(mesh_free) Mesh again;
    Error error = {0};
    if (!ply_parse(&again, bytes, size, "t.ply", &error))
        fail_msg("%s", error.text);
    assert_int_equal(again.vertex_count, mesh.vertex_count);
    assert_int_equal(again.triangle_count, mesh.triangle_count);
    assert_memory_equal(again.positions, mesh.positions, 4 * sizeof *mesh.positions);
    assert_memory_equal(again.triangles, mesh.triangles, 2 * sizeof *mesh.triangles);
    assert_int_equal(again.normals != NULL, mesh.normals != NULL);
    if (mesh.normals != NULL)
        assert_memory_equal(again.normals, mesh.normals, 4 * sizeof *mesh.normals);
    free(bytes);
}

#define MESH .triangles = triangles, .vertex_count = 4, .triangle_count = 2

TEST(a_mesh_comes_back_in_floats_where_they_suffice_and_with_its_normals)
{
    expect_same((Mesh){MESH, .positions = floats}, 12);
    expect_same((Mesh){MESH, .positions = doubles}, 24);
    expect_same((Mesh){MESH, .positions = doubles, .normals = normals}, 36);
}

TEST(an_empty_mesh_comes_back)
{
    char *bytes;
    size_t size;
    const Mesh empty = {0};
    FILE *stream = open_memstream(&bytes, &size);
    assert_true(ply_write(&empty, stream));
    fclose(stream);
    FREED_BY(mesh_free) Mesh again;
    Error error = {0};
    assert_true(ply_parse(&again, bytes, size, "t.ply", &error));
    assert_int_equal(again.vertex_count + again.triangle_count, 0);
    free(bytes);
}

TEST(a_full_disk_is_told)
{
    const Mesh mesh = {MESH, .positions = doubles};
    FILE *full = fopen("/dev/full", "wb");
    setvbuf(full, NULL, _IONBF, 0);
    assert_false(ply_write(&mesh, full));
    fclose(full);
}
