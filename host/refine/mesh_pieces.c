// SPDX-License-Identifier: MIT
// Joins vertices into pieces by union-find. Each vertex refers to a vertex of its piece with a
// lower index, and the root of a piece refers to itself.
#include "refine/mesh_pieces.h"

#include <stdlib.h>

// Returns the root of the vertex's piece, and shortens the path to the root.
static uint32_t lowest_of(uint32_t *lower, uint32_t vertex)
{
    while (lower[vertex] != vertex) {
        lower[vertex] = lower[lower[vertex]];
        vertex = lower[vertex];
    }
    return vertex;
}

// Joins the pieces of two vertices. Returns false if both vertices were in one piece already.
static bool join(uint32_t *lower, uint32_t one, uint32_t other)
{
    const uint32_t first = lowest_of(lower, one), second = lowest_of(lower, other);
    if (first < second)
        lower[second] = first;
    else
        lower[first] = second;
    return first != second;
}

// Merges small pieces into the first one. `sizes` has the number of triangles of each piece, at the
// index of its root. Replaces the sizes by the starts of the pieces.
static void lay_out(MeshPieces *pieces, uint32_t *lower, uint32_t *sizes, size_t count)
{
    uint32_t next = 0, *small = NULL;
    for (uint32_t vertex = 0; vertex < count; vertex++) {
        if (sizes[vertex] == 0 || sizes[vertex] >= PIECE_TRIANGLES)
            continue;
        if (small == NULL)
            small = &sizes[vertex];
        else {
            *small += sizes[vertex];
            sizes[vertex] = 0;
            lower[vertex] = (uint32_t)(small - sizes);
        }
    }
    for (uint32_t vertex = 0; vertex < count; vertex++) {
        const uint32_t start = next;
        next += sizes[vertex];
        if (sizes[vertex] > 0)
            pieces->ends[pieces->count++] = next;
        sizes[vertex] = start;
    }
}

static bool sort_triangles(MeshPieces *pieces, const Mesh *mesh, uint32_t *lower, Error *error)
{
    uint32_t *sizes = memory_zeroed(mesh->vertex_count, sizeof *sizes, error);
    pieces->order = memory_raw(mesh->triangle_count, sizeof *pieces->order, error);
    const bool ok = sizes != NULL && pieces->order != NULL;
    for (uint32_t i = 0; ok && i < mesh->triangle_count; i++)
        sizes[lowest_of(lower, mesh->triangles[i][0])]++;
    if (ok)
        lay_out(pieces, lower, sizes, mesh->vertex_count);
    for (uint32_t i = 0; ok && i < mesh->triangle_count; i++)
        pieces->order[sizes[lowest_of(lower, mesh->triangles[i][0])]++] = i;
    free(sizes);
    return ok;
}

bool mesh_pieces_make(MeshPieces *pieces, const Mesh *mesh, Error *error)
{
    size_t roots = mesh->vertex_count;
    *pieces = (MeshPieces){0};
    if (mesh->triangle_count == 0)
        return true;
    uint32_t *lower = memory_raw(mesh->vertex_count, sizeof *lower, error);
    pieces->ends = memory_raw(mesh->triangle_count, sizeof *pieces->ends, error);
    bool ok = lower != NULL && pieces->ends != NULL;
    for (uint32_t vertex = 0; ok && vertex < mesh->vertex_count; vertex++)
        lower[vertex] = vertex;
    for (uint32_t i = 0; ok && i < mesh->triangle_count; i++) {
        const uint32_t *vertices = mesh->triangles[i];
        roots -= join(lower, vertices[0], vertices[1]);
        roots -= join(lower, vertices[1], vertices[2]);
    }
    if (ok && roots == 1)
        pieces->ends[pieces->count++] = (uint32_t)mesh->triangle_count;
    else
        ok = ok && sort_triangles(pieces, mesh, lower, error);
    free(lower);
    if (!ok)
        mesh_pieces_free(pieces);
    return ok;
}

void mesh_pieces_free(MeshPieces *pieces)
{
    free(pieces->order);
    free(pieces->ends);
    *pieces = (MeshPieces){0};
}
