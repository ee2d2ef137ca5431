// SPDX-License-Identifier: MIT
// A concurrent union-find over vertices. Each vertex refers to a vertex with a lower index in its
// piece; the root refers to itself. Threads join pieces by linking a root to a lower root. The root
// of a piece is therefore its lowest vertex, regardless of the order of work.
#include "refine/thin_parts.h"

#include "base/array.h"

#include <stdatomic.h>
#include <stdlib.h>

typedef struct {
    const Mesh *mesh;
    _Atomic uint32_t *lower; // of each vertex
    _Atomic size_t joints;   // vertices that are no roots
    _Atomic bool are_many;
} Joining;

// Returns the root of the vertex's piece, and shortens the path to the root.
static uint32_t lowest_of(_Atomic uint32_t *lower, uint32_t vertex)
{
    uint32_t next = atomic_load_explicit(&lower[vertex], memory_order_relaxed);
    while (next != vertex) {
        const uint32_t further = atomic_load_explicit(&lower[next], memory_order_relaxed);
        if (further != next)
            atomic_store_explicit(&lower[vertex], further, memory_order_relaxed);
        vertex = next;
        next = further;
    }
    return vertex;
}

// Joins the pieces of two vertices. Returns false if both were in one piece.
static bool join(_Atomic uint32_t *lower, uint32_t one, uint32_t other)
{
    for (;;) {
        one = lowest_of(lower, one);
        other = lowest_of(lower, other);
        if (one == other)
            return false;
        uint32_t high = one > other ? one : other;
        const uint32_t low = one > other ? other : one;
        if (atomic_compare_exchange_strong(&lower[high], &high, low))
            return true;
    }
}

static void refer_to_themselves(void *context, uint32_t first, uint32_t end)
{
    const Joining *joining = context;
    for (uint32_t vertex = first; vertex < end; vertex++)
        atomic_store_explicit(&joining->lower[vertex], vertex, memory_order_relaxed);
}

static void join_triangles(void *context, uint32_t first, uint32_t end)
{
    Joining *joining = context;
    size_t joints = 0;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t *vertices = joining->mesh->triangles[i];
        joints += join(joining->lower, vertices[0], vertices[1]);
        joints += join(joining->lower, vertices[1], vertices[2]);
    }
    joining->joints += joints;
}

static uint32_t piece_of(const Joining *joining, uint32_t triangle)
{
    return lowest_of(joining->lower, joining->mesh->triangles[triangle][0]);
}

static void see_whether_many(void *context, uint32_t first, uint32_t end)
{
    Joining *joining = context;
    const uint32_t piece = piece_of(joining, 0);
    bool differs = false;
    for (uint32_t i = first; i < end && !differs; i++)
        differs = piece_of(joining, i) != piece;
    if (differs)
        joining->are_many = true;
}

static bool is_small(uint32_t triangles)
{
    return triangles > 0 && triangles < PIECE_TRIANGLES;
}

// Computes the start of each piece, indexed by its root, and the ends of all pieces. Small pieces
// come first and have one common end.
static void lay_out(MeshPieces *pieces, const uint32_t *sizes, uint32_t *starts, size_t count)
{
    uint32_t next = 0;
    for (size_t vertex = 0; vertex < count; vertex++)
        if (is_small(sizes[vertex])) {
            starts[vertex] = next;
            next += sizes[vertex];
        }
    if (next > 0)
        pieces->ends[pieces->count++] = next;
    for (size_t vertex = 0; vertex < count; vertex++)
        if (sizes[vertex] >= PIECE_TRIANGLES) {
            starts[vertex] = next;
            next += sizes[vertex];
            pieces->ends[pieces->count++] = next;
        }
}

static bool sort_triangles(MeshPieces *pieces, const Joining *joining, Error *error)
{
    const size_t vertices = joining->mesh->vertex_count, triangles = joining->mesh->triangle_count;
    uint32_t *sizes = memory_zeroed(vertices, sizeof *sizes, error);
    uint32_t *starts = memory_raw(vertices, sizeof *starts, error);
    pieces->order = memory_raw(triangles, sizeof *pieces->order, error);
    const bool ok = sizes != NULL && starts != NULL && pieces->order != NULL;
    for (uint32_t i = 0; ok && i < triangles; i++)
        sizes[piece_of(joining, i)]++;
    if (ok)
        lay_out(pieces, sizes, starts, vertices);
    for (uint32_t i = 0; ok && i < triangles; i++)
        pieces->order[starts[piece_of(joining, i)]++] = i;
    free(sizes);
    free(starts);
    return ok;
}

static bool find_pieces(MeshPieces *pieces, Joining *joining, ThreadPool *pool, Error *error)
{
    const uint32_t triangles = (uint32_t)joining->mesh->triangle_count;
    thread_pool_share(pool, (uint32_t)joining->mesh->vertex_count, CHUNK_ELEMENTS,
                      refer_to_themselves, joining);
    thread_pool_share(pool, triangles, CHUNK_ELEMENTS, join_triangles, joining);
    // If the joints do not connect all vertices, there may be several pieces, or vertices without
    // triangles.
    if (joining->joints + 1 < joining->mesh->vertex_count)
        thread_pool_share(pool, triangles, CHUNK_ELEMENTS, see_whether_many, joining);
    if (joining->are_many)
        return sort_triangles(pieces, joining, error);
    pieces->ends[0] = triangles;
    pieces->count = 1;
    return true;
}

bool mesh_pieces_make(MeshPieces *pieces, const Mesh *mesh, ThreadPool *pool, Error *error)
{
    Joining joining = {.mesh = mesh};
    *pieces = (MeshPieces){0};
    if (mesh->triangle_count == 0)
        return true;
    joining.lower = memory_raw(mesh->vertex_count, sizeof *joining.lower, error);
    pieces->ends = memory_raw(mesh->triangle_count, sizeof *pieces->ends, error);
    const bool ok =
        joining.lower != NULL && pieces->ends != NULL && find_pieces(pieces, &joining, pool, error);
    free(joining.lower);
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
