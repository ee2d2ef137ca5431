// SPDX-License-Identifier: MIT
// Makes a Surface of a Grid by naive surface nets (Gibson, "Constrained Elastic Surface Nets",
// MICCAI 1998). Every cell that the surface crosses gets a vertex, at the mean of the surface's
// crossings of the cell's edges. Every crossed grid edge gets a quad around it. The grid is
// well-composed, so a cell contains one sheet of the surface, and the quads form a closed surface.
#include "surface.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>

#define NO_VERTEX UINT32_MAX // all bytes 0xFF

// A cell has the index of the sample at its low corner.
typedef struct {
    const Grid *grid;
    uint32_t *vertex_of; // the vertex of each cell, or NO_VERTEX
    size_t step[3];      // from a sample to the next one along x, y, z
} Net;

static Vec3 crossing_mean(const Net *net, size_t cell)
{
    const float *values = net->grid->values + cell;
    double sum[3] = {0}, count = 0;
    for (unsigned edge = 0; edge < 12; edge++) {
        const unsigned axis = edge / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const unsigned at_u = edge & 1, at_v = edge >> 1 & 1;
        const size_t start = at_u * net->step[u] + at_v * net->step[v];
        const double a = (double)values[start], b = (double)values[start + net->step[axis]];
        if ((a < 0) == (b < 0))
            continue;
        sum[axis] += a / (a - b);
        sum[u] += at_u;
        sum[v] += at_v;
        count++;
    }
    return vec3(sum[0] / count, sum[1] / count, sum[2] / count);
}

static size_t number_cells(Net *net)
{
    const size_t end = grid_cell_end(net->grid);
    uint32_t count = 0;
    for (size_t cell = 0; cell < end; cell++) {
        const unsigned mask = grid_cell_mask(net->grid, cell);
        if (mask != 0 && mask != 0xFF)
            net->vertex_of[cell] = count++;
    }
    return count;
}

static void place_vertices(const Net *net, Vec3 *positions)
{
    const size_t row = net->step[1], layer = net->step[2], end = grid_cell_end(net->grid);
    for (size_t cell = 0; cell < end; cell++) {
        const uint32_t vertex = net->vertex_of[cell];
        if (vertex == NO_VERTEX)
            continue;
        const Vec3 corner =
            vec3((double)(cell % row), (double)(cell % layer / row), (double)(cell / layer));
        positions[vertex] = grid_point(net->grid, vec3_add(corner, crossing_mean(net, cell)));
    }
}

// Stores the quad around a grid edge, counter-clockwise as seen from the edge's outside end. All
// samples on the grid's faces are outside, so the four cells always exist.
static void put_quad(const Net *net, uint32_t quad[4], size_t sample, unsigned axis)
{
    const size_t u = net->step[(axis + 1) % 3], v = net->step[(axis + 2) % 3];
    const bool inside = net->grid->values[sample] < 0;
    quad[0] = net->vertex_of[sample - u - v];
    quad[1] = net->vertex_of[sample - (inside ? v : u)];
    quad[2] = net->vertex_of[sample];
    quad[3] = net->vertex_of[sample - (inside ? u : v)];
}

// Returns the number of crossed grid edges. Stores their quads unless quads is NULL. A crossed edge
// starts at the low corner of a cell that has a vertex.
static size_t visit_edges(const Net *net, uint32_t (*quads)[4])
{
    const float *values = net->grid->values;
    const size_t end = grid_cell_end(net->grid);
    size_t count = 0;
    for (size_t sample = 0; sample < end; sample++) {
        if (net->vertex_of[sample] == NO_VERTEX)
            continue;
        for (unsigned axis = 0; axis < 3; axis++) {
            if ((values[sample] < 0) == (values[sample + net->step[axis]] < 0))
                continue;
            if (quads != NULL)
                put_quad(net, quads[count], sample, axis);
            count++;
        }
    }
    return count;
}

static bool surface_reserve(Surface *surface, Error *error)
{
    surface->positions = memory_zeroed(surface->vertex_count, sizeof *surface->positions, error);
    surface->normals = memory_zeroed(surface->vertex_count, sizeof *surface->normals, error);
    surface->quads = memory_zeroed(surface->quad_count, sizeof *surface->quads, error);
    return surface->positions != NULL && surface->normals != NULL && surface->quads != NULL;
}

bool surface_extract(Surface *surface, const Grid *grid, Error *error)
{
    *surface = (Surface){0};
    const size_t row = (size_t)grid->size[0];
    Net net = {.grid = grid, .step = {1, row, row * (size_t)grid->size[1]}};
    net.vertex_of = memory_raw(grid_sample_count(grid), sizeof *net.vertex_of, error);
    if (net.vertex_of == NULL)
        return false;
    memset(net.vertex_of, 0xFF, grid_sample_count(grid) * sizeof *net.vertex_of);
    surface->vertex_count = number_cells(&net);
    surface->quad_count = visit_edges(&net, NULL);
    const bool reserved = surface_reserve(surface, error);
    if (reserved) {
        place_vertices(&net, surface->positions);
        visit_edges(&net, surface->quads);
    }
    free(net.vertex_of);
    return reserved;
}

void surface_free(Surface *surface)
{
    free(surface->positions);
    free(surface->normals);
    free(surface->quads);
    *surface = (Surface){0};
}
