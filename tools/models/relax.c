// SPDX-License-Identifier: MIT
// Evens out the vertices of a surface net. Each step moves a vertex along the surface toward the
// mean of its neighbors, then along the field's gradient onto the surface. See Ohtake, Belyaev,
// "Dual/Primal Mesh Optimization for Polygonized Implicit Surfaces", 2002. The resulting triangles
// are nearly equilateral, and vertices match the surface to second order.
#include "relax.h"

#include "base/array.h"

#include <stdlib.h>

// More steps hardly improve the triangles.
#define RELAX_STEPS 6

// The fraction of the way to its neighbors' mean that a vertex moves in a step.
#define RELAX_SPEED 0.6

// In one step, a vertex moves at most this many cells along the gradient. If the field has finer
// detail than the grid, a full step would fold the surface.
#define LONGEST_STEP 0.5

// The distance of the gradient's samples along each axis, in cells. This distance smooths creases
// that triangles cannot show.
#define GRADIENT_REACH 0.3

// Six steps remove every fold in the models. A vertex moves only while it belongs to a bad quad.
#define UNTANGLE_STEPS 6

// Twice the least area of a good triangle, divided by the sum of its squared edges. An equilateral
// triangle has 0.29.
#define LEAST_AREA 0.09

// The weight of a diagonal's length. The weight of its distance from the surface is 1.
#define LENGTH_FAULT 0.1

typedef struct {
    Vec3 gradient;
    double value;
} Slope;

// Evaluates the field at the four corners of a tetrahedron. Central differences would need six
// evaluations.
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

// Sums the positions of each vertex's neighbors. The quads of a closed surface contain each edge
// once in each direction, so every neighbor counts once.
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

// Sums the cross products of the diagonals of the quads at each vertex. Each product is twice the
// quad's area vector, so the sum is a normal weighted by area.
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

// Returns whether the triangle of this corner and the next two is a needle or folded over. This is
// true if the area, seen along the mean vertex normal, is too small for the lengths of the edges.
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

// At creases that the cells cannot resolve, vertices slide over each other. Moves the vertices of
// bad quads to their neighbors' mean, which is off the surface by a fraction of a cell. Each vertex
// gets the mean normal of its quads.
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

// Returns how badly the diagonal from this corner matches the surface: the distance of its middle
// from the surface, plus a fraction of its length. The length decides on flat surfaces.
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
