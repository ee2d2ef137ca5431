// SPDX-License-Identifier: MIT
// Moves the vertices of a surface net to better places: each step goes toward the mean of the
// neighbors, but only along the surface, and then down the field's gradient onto the surface
// (as in Ohtake, Belyaev: "Dual/Primal Mesh Optimization for Polygonized Implicit Surfaces",
// 2002).  Triangles come out nearly even and the surface is met to second order.
#include "relax.h"

#include "base/array.h"

#include <stdlib.h>

// More even out little further.
#define RELAX_STEPS 6

// The fraction of the way to the neighbors' mean per step.
#define RELAX_SPEED 0.6

// A vertex moves at most that many cells onto the surface in one step: where the field is bent
// more sharply than the grid shows, a full step would fold the surface.
#define LONGEST_STEP 0.5

// Distance of the gradient's samples, in cells: smooths creases that the triangles cannot show.
#define GRADIENT_REACH 0.3

// Six undo every fold in our models; a vertex moves only while its quads are bad.
#define UNTANGLE_STEPS 6

// Twice the least area of a good triangle, of its edges' squares; 0.29 in an even triangle.
#define LEAST_AREA 0.09

// The weight of a cut's length relative to its distance from the surface.
#define LENGTH_FAULT 0.1

typedef struct {
    Vec3 gradient;
    double value;
} Slope;

// From the corners of a tetrahedron: four evaluations, where central differences take six.
static Slope field_slope(Field *field, Vec3 p, double reach)
{
    const double a = field(vec3(p.x + reach, p.y + reach, p.z + reach));
    const double b = field(vec3(p.x + reach, p.y - reach, p.z - reach));
    const double c = field(vec3(p.x - reach, p.y + reach, p.z - reach));
    const double d = field(vec3(p.x - reach, p.y - reach, p.z + reach));
    const Vec3 sum = vec3(a + b - c - d, a - b + c - d, a - b - c + d);
    return (Slope){vec3_scale(sum, 0.25 / reach), 0.25 * (a + b + c + d)};
}

static Vec3 onto_surface(Vec3 p, Slope slope, double cell)
{
    const double steepness = vec3_dot(slope.gradient, slope.gradient);
    if (!(steepness > 0))
        return p;
    Vec3 way = vec3_scale(slope.gradient, -slope.value / steepness);
    const double length = sqrt(vec3_dot(way, way));
    if (length > LONGEST_STEP * cell)
        way = vec3_scale(way, LONGEST_STEP * cell / length);
    return vec3_add(p, way);
}

// Each edge of a closed surface is walked once in each direction by the quads beside it, so that
// adding every edge's end to its start visits each neighbor once.
static void sum_neighbors(const Surface *surface, Vec3 *sums, double *counts)
{
    for (size_t vertex = 0; vertex < surface->vertex_count; vertex++) {
        sums[vertex] = vec3(0, 0, 0);
        counts[vertex] = 0;
    }
    for (size_t quad = 0; quad < surface->quad_count; quad++)
        for (int corner = 0; corner < 4; corner++) {
            const uint32_t from = surface->quads[quad][corner];
            const uint32_t to = surface->quads[quad][(corner + 1) % 4];
            sums[from] = vec3_add(sums[from], surface->positions[to]);
            counts[from]++;
        }
}

static void relax_step(Surface *surface, const Model *model, Vec3 *sums, double *counts)
{
    sum_neighbors(surface, sums, counts);
    for (size_t vertex = 0; vertex < surface->vertex_count; vertex++) {
        Vec3 *position = &surface->positions[vertex];
        const Vec3 normal = surface->normals[vertex];
        const Vec3 mean = vec3_scale(sums[vertex], 1 / counts[vertex]);
        const Vec3 way = vec3_scale(vec3_sub(mean, *position), RELAX_SPEED);
        const Vec3 sideways = vec3_sub(way, vec3_scale(normal, vec3_dot(way, normal)));
        *position = vec3_add(*position, sideways);
        const double cell = grid_cell_size(model, *position);
        const Slope slope = field_slope(model->field, *position, GRADIENT_REACH * cell);
        *position = onto_surface(*position, slope, cell);
        surface->normals[vertex] = vec3_normalize(slope.gradient);
    }
}

// The normals that the triangles themselves give, weighted by area: half the cross product of a
// quad's diagonals is its area vector.
static void sum_facings(const Surface *surface, Vec3 *facings)
{
    for (size_t vertex = 0; vertex < surface->vertex_count; vertex++)
        facings[vertex] = vec3(0, 0, 0);
    for (size_t index = 0; index < surface->quad_count; index++) {
        const uint32_t *quad = surface->quads[index];
        const Vec3 *positions = surface->positions;
        const Vec3 area = vec3_cross(vec3_sub(positions[quad[2]], positions[quad[0]]),
                                     vec3_sub(positions[quad[3]], positions[quad[1]]));
        for (int corner = 0; corner < 4; corner++)
            facings[quad[corner]] = vec3_add(facings[quad[corner]], area);
    }
}

// Whether the triangle from that corner on is a needle or folded over: its area against its
// vertices' normals is small for its edges.
static bool triangle_is_bad(const Surface *surface, const uint32_t quad[4], int corner)
{
    const uint32_t first = quad[corner], second = quad[(corner + 1) % 4];
    const uint32_t third = quad[(corner + 2) % 4];
    const Vec3 a = surface->positions[first], b = surface->positions[second];
    const Vec3 c = surface->positions[third], *normals = surface->normals;
    const Vec3 ab = vec3_sub(b, a), bc = vec3_sub(c, b), ca = vec3_sub(a, c);
    const Vec3 facing = vec3_add(normals[first], vec3_add(normals[second], normals[third]));
    const double squares = vec3_dot(ab, ab) + vec3_dot(bc, bc) + vec3_dot(ca, ca);
    const double least = LEAST_AREA * squares * sqrt(vec3_dot(facing, facing));
    return !(vec3_dot(vec3_cross(ab, bc), facing) > least);
}

static bool quad_is_bad(const Surface *surface, const uint32_t quad[4])
{
    for (int corner = 0; corner < 4; corner++)
        if (triangle_is_bad(surface, quad, corner))
            return true;
    return false;
}

// Where the field has a crease that the cells cannot show, vertices slide over each other; those
// of bad quads go to their neighbors' mean, off the surface by a part of a cell, and take the
// normals of the triangles there.
static void untangle_step(Surface *surface, Vec3 *sums, double *counts, Vec3 *facings)
{
    sum_neighbors(surface, sums, counts);
    sum_facings(surface, facings);
    for (size_t index = 0; index < surface->quad_count; index++) {
        const uint32_t *quad = surface->quads[index];
        if (!quad_is_bad(surface, quad))
            continue;
        for (int corner = 0; corner < 4; corner++) {
            const uint32_t vertex = quad[corner];
            surface->positions[vertex] = vec3_scale(sums[vertex], 1 / counts[vertex]);
            surface->normals[vertex] = vec3_normalize(facings[vertex]);
        }
    }
}

// How badly the diagonal from that corner would stand for the surface: how far its middle is
// off it, and a little of its length, which decides where the surface is flat.
static double diagonal_fault(const Surface *surface, const Model *model, const uint32_t quad[4],
                             int corner)
{
    const Vec3 a = surface->positions[quad[corner]], b = surface->positions[quad[corner + 2]];
    const Vec3 way = vec3_sub(b, a);
    const double off = fabs(model->field(vec3_scale(vec3_add(a, b), 0.5)));
    return off + LENGTH_FAULT * sqrt(vec3_dot(way, way));
}

static void cut_along_better_diagonals(Surface *surface, const Model *model)
{
    for (size_t index = 0; index < surface->quad_count; index++) {
        uint32_t *quad = surface->quads[index];
        if (diagonal_fault(surface, model, quad, 0) <= diagonal_fault(surface, model, quad, 1))
            continue;
        const uint32_t first = quad[0];
        quad[0] = quad[1];
        quad[1] = quad[2];
        quad[2] = quad[3];
        quad[3] = first;
    }
}

bool relax_surface(Surface *surface, const Model *model, Error *error)
{
    Vec3 *sums = memory_raw(surface->vertex_count, sizeof *sums, error);
    Vec3 *facings = memory_raw(surface->vertex_count, sizeof *facings, error);
    double *counts = memory_raw(surface->vertex_count, sizeof *counts, error);
    const bool reserved = sums != NULL && facings != NULL && counts != NULL;
    for (int step = 0; reserved && step < RELAX_STEPS; step++)
        relax_step(surface, model, sums, counts);
    for (int step = 0; reserved && step < UNTANGLE_STEPS; step++)
        untangle_step(surface, sums, counts, facings);
    if (reserved)
        cut_along_better_diagonals(surface, model);
    free(counts);
    free(facings);
    free(sums);
    return reserved;
}
