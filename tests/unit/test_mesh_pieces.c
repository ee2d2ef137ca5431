// SPDX-License-Identifier: MIT
// Tests how meshes are divided into pieces of connected triangles. All small pieces become one
// piece.
#include "mesh/mesh_pieces.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <stdlib.h>

static Mesh mesh_of(uint32_t vertices, uint32_t triangles)
{
    Mesh mesh = {.vertex_count = vertices, .triangle_count = triangles};
    mesh.triangles = calloc(triangles, sizeof *mesh.triangles);
    assert_non_null(mesh.triangles);
    return mesh;
}

static MeshPieces pieces_of(const Mesh *mesh)
{
    Error error;
    MeshPieces pieces;
    assert_true(mesh_pieces_make(&pieces, mesh, &error));
    return pieces;
}

// Adds a band of triangles. Each triangle shares two vertices with the next triangle.
static void fill_band(Mesh *mesh, uint32_t first, uint32_t end, uint32_t vertex)
{
    for (uint32_t i = first; i < end; i++)
        for (uint32_t corner = 0; corner < 3; corner++)
            mesh->triangles[i][corner] = vertex + i - first + corner;
}

TEST(a_mesh_of_one_piece_keeps_its_order)
{
    Mesh mesh = mesh_of(1002, 1000);
    fill_band(&mesh, 0, 1000, 0);
    FREED_BY(mesh_pieces_free) MeshPieces pieces = pieces_of(&mesh);
    assert_int_equal(pieces.count, 1);
    assert_int_equal(pieces.ends[0], 1000);
    assert_null(pieces.order);
    free(mesh.triangles);
}

// Computes the lowest vertex of each vertex's piece by passes over all triangles until nothing
// changes.
static void find_lowest(const Mesh *mesh, uint32_t *lowest)
{
    bool changes = true;
    for (uint32_t vertex = 0; vertex < mesh->vertex_count; vertex++)
        lowest[vertex] = vertex;
    while (changes) {
        changes = false;
        for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++) {
            const uint32_t *corners = mesh->triangles[i / 3];
            const uint32_t one = corners[i % 3], other = corners[(i + 1) % 3];
            const uint32_t least = lowest[one] < lowest[other] ? lowest[one] : lowest[other];
            changes |= lowest[one] != least || lowest[other] != least;
            lowest[one] = lowest[other] = least;
        }
    }
}

static void expect_pieces(const Mesh *mesh, const MeshPieces *pieces, const uint32_t *lowest)
{
    uint32_t first = 0, last_lowest = 0;
    for (uint32_t piece = 0; piece < pieces->count; piece++) {
        const uint32_t of_piece = lowest[mesh->triangles[pieces->order[first]][0]];
        assert_true(pieces->ends[piece] > first);
        assert_true(piece == 0 || of_piece > last_lowest);
        for (uint32_t i = first; i < pieces->ends[piece]; i++) {
            assert_int_equal(lowest[mesh->triangles[pieces->order[i]][0]], of_piece);
            assert_true(i == first || pieces->order[i] > pieces->order[i - 1]);
        }
        last_lowest = of_piece;
        first = pieces->ends[piece];
    }
    assert_int_equal(first, mesh->triangle_count);
}

#define VERTICES  40000
#define TRIANGLES 80000

// The corners of each random triangle are in one range of a thousand vertices.
TEST(pieces_are_connected_by_shared_vertices)
{
    uint64_t random = 1;
    Mesh mesh = mesh_of(VERTICES, TRIANGLES);
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        const uint32_t stretch = 1000 * random_below(&random, VERTICES / 1000);
        for (int corner = 0; corner < 3; corner++)
            mesh.triangles[i][corner] = stretch + random_below(&random, 1000);
    }
    static uint32_t lowest[VERTICES];
    find_lowest(&mesh, lowest);
    FREED_BY(mesh_pieces_free) MeshPieces pieces = pieces_of(&mesh);
    expect_pieces(&mesh, &pieces, lowest);
    free(mesh.triangles);
}

TEST(small_pieces_are_one)
{
    const uint32_t small = 30, band = PIECE_TRIANGLES;
    Mesh mesh = mesh_of(3 * small + band + 2, small + band);
    fill_band(&mesh, 0, 1, 0);
    fill_band(&mesh, 1, 1 + band, 3);
    for (uint32_t i = 1; i < small; i++)
        fill_band(&mesh, band + i, band + i + 1, band + 2 + 3 * i);
    FREED_BY(mesh_pieces_free) MeshPieces pieces = pieces_of(&mesh);
    assert_int_equal(pieces.count, 2);
    assert_int_equal(pieces.ends[0], small);
    assert_int_equal(pieces.order[0], 0);
    assert_int_equal(pieces.order[1], 1 + band);
    assert_int_equal(pieces.ends[1], small + band);
    free(mesh.triangles);
}

TEST(no_triangles_are_no_pieces)
{
    const Mesh mesh = {0};
    FREED_BY(mesh_pieces_free) MeshPieces pieces = pieces_of(&mesh);
    assert_int_equal(pieces.count, 0);
}
