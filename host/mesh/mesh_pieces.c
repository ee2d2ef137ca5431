// SPDX-License-Identifier: MIT
// Joins the vertices of triangles into pieces by union-find.
#include "mesh/mesh_pieces.h"

#include "base/union_find.h"

#include <stdlib.h>

// Merges all small pieces into the first small one. `sizes` has the number of triangles of each
// piece, at the index of the piece's root. Replaces the sizes by the starts of the pieces.
static void lay_out(MeshPieces *pieces, uint32_t *parents, uint32_t *sizes, size_t count)
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
            parents[vertex] = (uint32_t)(small - sizes);
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

static bool sort_triangles(MeshPieces *pieces, const Mesh *mesh, uint32_t *parents, Error *error)
{
    uint32_t *sizes = memory_zeroed(mesh->vertex_count, sizeof *sizes, error);
    pieces->order = memory_raw(mesh->triangle_count, sizeof *pieces->order, error);
    const bool ok = sizes != NULL && pieces->order != NULL;
    for (uint32_t i = 0; ok && i < mesh->triangle_count; i++)
        sizes[set_root(parents, mesh->triangles[i][0])]++;
    if (ok)
        lay_out(pieces, parents, sizes, mesh->vertex_count);
    for (uint32_t i = 0; ok && i < mesh->triangle_count; i++)
        pieces->order[sizes[set_root(parents, mesh->triangles[i][0])]++] = i;
    free(sizes);
    return ok;
}

bool mesh_pieces_make(MeshPieces *pieces, const Mesh *mesh, Error *error)
{
    size_t roots = mesh->vertex_count;
    *pieces = (MeshPieces){0};
    if (mesh->triangle_count == 0)
        return true;
    uint32_t *parents = sets_make(mesh->vertex_count, error);
    pieces->ends = memory_raw(mesh->triangle_count, sizeof *pieces->ends, error);
    bool ok = parents != NULL && pieces->ends != NULL;
    for (uint32_t i = 0; ok && i < mesh->triangle_count; i++) {
        const uint32_t *vertices = mesh->triangles[i];
        roots -= sets_join(parents, vertices[0], vertices[1]);
        roots -= sets_join(parents, vertices[1], vertices[2]);
    }
    if (ok && roots == 1)
        pieces->ends[pieces->count++] = (uint32_t)mesh->triangle_count;
    else
        ok = ok && sort_triangles(pieces, mesh, parents, error);
    free(parents);
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
