// SPDX-License-Identifier: MIT
// Checks that a surface is closed, consistently wound and oriented outward.
#include "closed.h"

#include "base/array.h"

#include <stdlib.h>

// The directed edges, sorted by their start. The edges from vertex v end at ends[i] for first[v] <=
// i < first[v + 1].
typedef struct {
    size_t *first;
    uint32_t *ends;
} Edges;

static const int triangle_corners[2][3] = {{0, 1, 2}, {0, 2, 3}};

static void visit_edges(const Surface *surface, Edges *edges, bool fill)
{
    for (size_t quad = 0; quad < surface->quad_count; quad++)
        for (int edge = 0; edge < 6; edge++) {
            const int *corners = triangle_corners[edge / 3];
            const uint32_t from = surface->quads[quad][corners[edge % 3]];
            const uint32_t to = surface->quads[quad][corners[(edge + 1) % 3]];
            if (fill)
                edges->ends[--edges->first[from + 1]] = to;
            else
                edges->first[from + 1]++;
        }
}

// A counting sort. The second visit fills the range of each vertex v from its end. Afterward,
// first[v + 1] is the start of v's range, so the last loop shifts the table down by one.
static void sort_edges(const Surface *surface, Edges *edges)
{
    const size_t count = surface->vertex_count;
    visit_edges(surface, edges, false);
    for (size_t vertex = 0; vertex < count; vertex++)
        edges->first[vertex + 1] += edges->first[vertex];
    visit_edges(surface, edges, true);
    for (size_t vertex = 0; vertex < count; vertex++)
        edges->first[vertex] = edges->first[vertex + 1];
    edges->first[count] = surface->quad_count * 6;
}

static size_t edge_count(const Edges *edges, uint32_t from, uint32_t to)
{
    size_t count = 0;
    for (size_t edge = edges->first[from]; edge < edges->first[from + 1]; edge++)
        count += edges->ends[edge] == to;
    return count;
}

static bool edges_have_twins(const Surface *surface, const Edges *edges)
{
    for (size_t vertex = 0; vertex < surface->vertex_count; vertex++)
        for (size_t edge = edges->first[vertex]; edge < edges->first[vertex + 1]; edge++) {
            const uint32_t from = (uint32_t)vertex, to = edges->ends[edge];
            if (edge_count(edges, from, to) != 1 || edge_count(edges, to, from) != 1)
                return false;
        }
    return true;
}

// Returns six times the enclosed volume, by the divergence theorem.
static double enclosed_volume(const Surface *surface)
{
    double volume = 0;
    for (size_t quad = 0; quad < surface->quad_count; quad++)
        for (int triangle = 0; triangle < 2; triangle++) {
            const int *corners = triangle_corners[triangle];
            const Vec3 a = surface->positions[surface->quads[quad][corners[0]]];
            const Vec3 b = surface->positions[surface->quads[quad][corners[1]]];
            const Vec3 c = surface->positions[surface->quads[quad][corners[2]]];
            volume += vec3_dot(a, vec3_cross(b, c));
        }
    return volume;
}

bool closed_check(const Surface *surface, const char *name, Error *error)
{
    Edges edges = {
        .first = memory_zeroed(surface->vertex_count + 1, sizeof *edges.first, error),
        .ends = memory_raw(surface->quad_count * 6, sizeof *edges.ends, error),
    };
    bool good = edges.first != NULL && edges.ends != NULL;
    if (good) {
        sort_edges(surface, &edges);
        good = edges_have_twins(surface, &edges) ||
               error_set(error, "the model %s is not closed: an edge has no unique twin", name);
    }
    if (good && !(enclosed_volume(surface) > 0))
        good = error_set(error, "the model %s is inside out", name);
    free(edges.ends);
    free(edges.first);
    return good;
}
