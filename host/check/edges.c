// SPDX-License-Identifier: MIT
// Puts the sides of all edges into buckets, one per lower point, then sorts each bucket of about
// six sides. The lower point of an edge has the lower index.
#include "check/edges.h"

#include "base/array.h"

#include <stdlib.h>

// Longer buckets use qsort. For shorter ones, insertion sort is faster.
#define FEW_SIDES 24

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

static void sort_sides(EdgeSide *sides, size_t count)
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

// Sets first[point] to the end of the point's bucket.
static void count_sides(Edges *edges, const Mesh *mesh, const Weld *weld)
{
    for (uint32_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            edges->first[side_of(mesh, weld, triangle, corner).low]++;
    size_t sum = 0;
    for (size_t point = 0; point <= mesh->vertex_count; point++) {
        sum += edges->first[point];
        edges->first[point] = sum;
    }
}

// Fills each bucket from its end. Afterwards, first[point] is the start of the point's bucket.
static void place_sides(Edges *edges, const Mesh *mesh, const Weld *weld)
{
    for (uint32_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++) {
            const LowSide found = side_of(mesh, weld, triangle, corner);
            edges->sides[--edges->first[found.low]] = found.side;
        }
}

bool edges_make(Edges *edges, const Mesh *mesh, const Weld *weld, Error *error)
{
    edges->sides = memory_raw(3 * mesh->triangle_count, sizeof *edges->sides, error);
    edges->first = memory_zeroed(mesh->vertex_count + 1, sizeof *edges->first, error);
    if (edges->sides == NULL || edges->first == NULL) {
        edges_free(edges);
        return false;
    }
    count_sides(edges, mesh, weld);
    place_sides(edges, mesh, weld);
    for (size_t point = 0; point < mesh->vertex_count; point++)
        sort_sides(&edges->sides[edges->first[point]],
                   edges->first[point + 1] - edges->first[point]);
    return true;
}

void edges_free(Edges *edges)
{
    free(edges->sides);
    free(edges->first);
    *edges = (Edges){0};
}
