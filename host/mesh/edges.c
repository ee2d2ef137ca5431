// SPDX-License-Identifier: MIT
// A hash table with open addressing finds the vertex with the lowest index at each position. A
// counting sort puts each EdgeSide into the bucket of its edge's lower point. Each bucket is then
// sorted. The average bucket has about six sides. Fans are joined by union-find.
#include "mesh/edges.h"

#include "base/thread_pool.h"
#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

// Insertion sort sorts buckets of up to this many sides, and qsort larger buckets.
#define FEW_SIDES 24

typedef struct {
    uint32_t *vertices; // WELD_UNUSED in empty slots
    size_t mask;        // slots minus one; the number of slots is a power of two
} Table;

// Copies a position for hashing. Adding 0.0 turns negative zero into zero, so that both zeros have
// the same bits.
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

// Sets weld->points to WELD_UNUSED for unused vertices, and to 0 for all others.
static void mark_used(Weld *weld, const Mesh *mesh)
{
    memset(weld->points, 0xff, mesh->vertex_count * sizeof *weld->points);
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            weld->points[mesh->triangles[triangle][corner]] = 0;
}

static bool weld_make(Weld *weld, const Mesh *mesh, Error *error)
{
    Table table;
    *weld = (Weld){.points = memory_raw(mesh->vertex_count, sizeof *weld->points, error)};
    if (weld->points == NULL || !make_table(&table, mesh->vertex_count, error))
        return false;
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

typedef struct {
    uint32_t low;
    EdgeSide side;
} LowSide;

static LowSide side_of(const Mesh *mesh, const Weld *weld, uint32_t triangle, int corner)
{
    const uint32_t *corners = mesh->triangles[triangle];
    const uint32_t from = weld->points[corners[corner]];
    const uint32_t to = weld->points[corners[(corner + 1) % 3]];
    const uint32_t opposite = weld->points[corners[(corner + 2) % 3]];
    return (LowSide){from < to ? from : to,
                     {.high = from < to ? to : from,
                      .opposite = opposite,
                      .triangle = triangle & 0x7fffffff,
                      .falling = from > to}};
}

static int compare_sides(const void *first, const void *second)
{
    const EdgeSide *a = first, *b = second;
    if (a->high != b->high)
        return a->high < b->high ? -1 : 1;
    if (a->opposite != b->opposite)
        return a->opposite < b->opposite ? -1 : 1;
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static void sort_bucket(EdgeSide *sides, size_t count)
{
    if (count > FEW_SIDES) {
        qsort(sides, count, sizeof *sides, compare_sides);
        return;
    }
    for (size_t sorted = 1; sorted < count; sorted++) {
        const EdgeSide side = sides[sorted];
        size_t place = sorted;
        for (; place > 0 && compare_sides(&side, &sides[place - 1]) < 0; place--)
            sides[place] = sides[place - 1];
        sides[place] = side;
    }
}

static void sort_buckets(void *context, uint32_t first, uint32_t end)
{
    const Edges *edges = context;
    for (uint32_t point = first; point < end; point++)
        sort_bucket(&edges->sides[edges->first[point]],
                    edges->first[point + 1] - edges->first[point]);
}

// Sets first[point] to the end of the point's bucket.
static void count_sides(Edges *edges, const Mesh *mesh)
{
    for (uint32_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            edges->first[side_of(mesh, &edges->weld, triangle, corner).low]++;
    uint32_t sum = 0;
    for (size_t point = 0; point <= mesh->vertex_count; point++) {
        sum += edges->first[point];
        edges->first[point] = sum;
    }
}

// Fills each bucket from its end. Afterwards, first[point] is the start of the point's bucket.
static void place_sides(Edges *edges, const Mesh *mesh)
{
    for (uint32_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++) {
            const LowSide found = side_of(mesh, &edges->weld, triangle, corner);
            edges->sides[--edges->first[found.low]] = found.side;
        }
}

bool edges_make(Edges *edges, const Mesh *mesh, Error *error)
{
    *edges = (Edges){0};
    if (mesh->triangle_count > UINT32_MAX / 3)
        return error_set(error, "one mesh has %zu triangles, more than %u", mesh->triangle_count,
                         UINT32_MAX / 3);
    edges->side_count = 3 * mesh->triangle_count;
    edges->sides = memory_raw(3 * mesh->triangle_count, sizeof *edges->sides, error);
    edges->first = memory_zeroed(mesh->vertex_count + 1, sizeof *edges->first, error);
    if (edges->sides == NULL || edges->first == NULL || !weld_make(&edges->weld, mesh, error)) {
        edges_free(edges);
        return false;
    }
    count_sides(edges, mesh);
    place_sides(edges, mesh);
    ThreadPool *pool = thread_pool_open(0);
    thread_pool_share(pool, (uint32_t)mesh->vertex_count, CHUNK_ELEMENTS, sort_buckets, edges);
    thread_pool_close(pool);
    return true;
}

void edges_free(Edges *edges)
{
    free(edges->weld.points);
    free(edges->sides);
    free(edges->first);
    *edges = (Edges){0};
}

bool edges_next(const Edges *edges, Edge *edge)
{
    const EdgeSide *next = edge->sides == NULL ? edges->sides : edge->sides + edge->count;
    const size_t place = (size_t)(next - edges->sides);
    if (place == edges->side_count)
        return false;
    while (edges->first[edge->low + 1] <= place)
        edge->low++;
    edge->sides = next;
    edge->count = 1;
    while (place + edge->count < edges->first[edge->low + 1] &&
           next[edge->count].high == next->high)
        edge->count++;
    return true;
}

bool fans_make(Fans *fans, const Mesh *mesh, const Edges *edges, Error *error)
{
    *fans = (Fans){mesh, &edges->weld, sets_make(3 * mesh->triangle_count, error)};
    return fans->parents != NULL;
}

static uint32_t corner_at(const Fans *fans, uint32_t triangle, uint32_t point)
{
    const uint32_t *corners = fans->mesh->triangles[triangle];
    for (uint32_t corner = 0; corner < 2; corner++)
        if (fans->weld->points[corners[corner]] == point)
            return 3 * triangle + corner;
    return 3 * triangle + 2;
}

void fans_join(const Fans *fans, uint32_t point, uint32_t triangle, uint32_t other)
{
    sets_join(fans->parents, corner_at(fans, triangle, point), corner_at(fans, other, point));
}

// Parents are lower than their children, so the loop numbers the parents first.
uint32_t fans_number(Fans *fans)
{
    uint32_t count = 0, *parents = fans->parents;
    for (size_t corner = 0; corner < 3 * fans->mesh->triangle_count; corner++)
        parents[corner] = parents[corner] == corner ? count++ : parents[parents[corner]];
    return count;
}
