// SPDX-License-Identifier: MIT
// Finds equal positions with an open-addressed hash table of the lowest vertex at each position.
#include "mesh/weld.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

typedef struct {
    uint32_t *vertices; // WELD_UNUSED in empty slots
    size_t mask;        // slots minus one; the number of slots is a power of two
} Table;

// Adding 0.0 turns negative zero into zero, so that both have the same bits.
static void copy_position(const Mesh *mesh, uint32_t vertex, double position[3])
{
    for (int axis = 0; axis < 3; axis++)
        position[axis] = mesh->positions[vertex][axis] + 0.0;
}

static uint32_t find_or_insert(const Table *table, const Mesh *mesh, uint32_t vertex)
{
    double position[3], other[3];
    copy_position(mesh, vertex, position);
    size_t place = XXH3_64bits(position, sizeof position) & table->mask;
    for (;; place = (place + 1) & table->mask) {
        const uint32_t held = table->vertices[place];
        if (held == WELD_UNUSED) {
            table->vertices[place] = vertex;
            return vertex;
        }
        copy_position(mesh, held, other);
        if (memcmp(position, other, sizeof position) == 0)
            return held;
    }
}

static bool make_table(Table *table, size_t count, Error *error)
{
    size_t places = 16;
    while (places < 2 * count)
        places *= 2;
    table->mask = places - 1;
    table->vertices = memory_raw(places, sizeof *table->vertices, error);
    if (table->vertices != NULL)
        memset(table->vertices, 0xff, places * sizeof *table->vertices);
    return table->vertices != NULL;
}

// Stores WELD_UNUSED for unused vertices, and 0 for all others.
static void mark_used(Weld *weld, const Mesh *mesh)
{
    memset(weld->points, 0xff, mesh->vertex_count * sizeof *weld->points);
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            weld->points[mesh->triangles[triangle][corner]] = 0;
}

bool weld_make(Weld *weld, const Mesh *mesh, Error *error)
{
    Table table;
    *weld = (Weld){.points = memory_raw(mesh->vertex_count, sizeof *weld->points, error)};
    if (weld->points == NULL || !make_table(&table, mesh->vertex_count, error)) {
        weld_free(weld);
        return false;
    }
    mark_used(weld, mesh);
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
        if (weld->points[vertex] == WELD_UNUSED) {
            weld->unused_count++;
            continue;
        }
        weld->points[vertex] = find_or_insert(&table, mesh, (uint32_t)vertex);
        weld->repeated_count += weld->points[vertex] != vertex;
    }
    free(table.vertices);
    return true;
}

void weld_free(Weld *weld)
{
    free(weld->points);
    *weld = (Weld){0};
}
