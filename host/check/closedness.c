// SPDX-License-Identifier: MIT
// Visits each edge once and joins its triangles into fans. A point with several fans is pinched.
#include "check/census.h"

#include "base/array.h"

#include <stdlib.h>

static void judge_edge(Closedness *closedness, const EdgeSide *sides, size_t count)
{
    uint32_t lowest = sides[0].triangle;
    for (size_t side = 1; side < count; side++) {
        lowest = sides[side].triangle < lowest ? sides[side].triangle : lowest;
        // A duplicate triangle counts only once, at the edge of its two lower points.
        if (sides[side].opposite == sides[side - 1].opposite &&
            sides[side].opposite > sides[side].high)
            mesh_fault_add(&closedness->duplicates, sides[side].triangle);
    }
    closedness->edge_count++;
    if (count == 1)
        mesh_fault_add(&closedness->open, lowest);
    else if (count > 2)
        mesh_fault_add(&closedness->crowded, lowest);
    else if (sides[0].falling == sides[1].falling)
        mesh_fault_add(&closedness->turned, lowest);
}

static void visit_edges(Closedness *closedness, const Edges *edges, Fans *fans)
{
    Edge edge = {0};
    while (edges_next(edges, &edge)) {
        const EdgeSide *sides = edge.sides;
        judge_edge(closedness, sides, edge.count);
        for (size_t side = 1; side < edge.count; side++) {
            fans_join(fans, edge.low, sides[0].triangle, sides[side].triangle);
            fans_join(fans, sides[0].high, sides[0].triangle, sides[side].triangle);
        }
    }
}

static bool count_pinched(Closedness *closedness, const Fans *fans, Error *error)
{
    const Mesh *mesh = fans->mesh;
    bool *has_fan = memory_zeroed(mesh->vertex_count, sizeof *has_fan, error);
    bool *is_pinched = memory_zeroed(mesh->vertex_count, sizeof *is_pinched, error);
    const bool ok = has_fan != NULL && is_pinched != NULL;
    for (uint32_t corner = 0; ok && corner < 3 * mesh->triangle_count; corner++) {
        const uint32_t point = fans->weld->points[mesh->triangles[corner / 3][corner % 3]];
        if (fans->parents[corner] != corner)
            continue;
        if (has_fan[point] && !is_pinched[point]) {
            mesh_fault_add(&closedness->pinched, corner / 3);
            is_pinched[point] = true;
        }
        has_fan[point] = true;
    }
    free(has_fan);
    free(is_pinched);
    return ok;
}

static Vec3 corner_position(const Mesh *mesh, size_t triangle, int corner)
{
    return vec3_of_doubles(mesh->positions[mesh->triangles[triangle][corner]]);
}

// Returns six times the mesh's volume, scaled to prevent overflow. The result is positive if the
// backs of the triangles face the inside.
static double signed_volume(const Mesh *mesh)
{
    double volume = 0;
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    mesh_add_bounds(mesh, &low, &high);
    const double scale = 1 / vec3_extent(vec3_sub(high, low));
    const Vec3 origin = corner_position(mesh, 0, 0);
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
        Vec3 corners[3];
        for (int corner = 0; corner < 3; corner++)
            corners[corner] =
                vec3_scale(vec3_sub(corner_position(mesh, triangle, corner), origin), scale);
        volume += vec3_dot(corners[0], vec3_cross(corners[1], corners[2]));
    }
    return volume;
}

bool closedness_find(Closedness *closedness, const Mesh *mesh, const Weld *weld, const Edges *edges,
                     Error *error)
{
    Fans fans;
    *closedness = (Closedness){0};
    if (!fans_make(&fans, mesh, weld, error))
        return false;
    visit_edges(closedness, edges, &fans);
    const bool ok = count_pinched(closedness, &fans, error);
    closedness->is_closed = mesh->triangle_count > 0 && closedness->open.count == 0 &&
                            closedness->crowded.count == 0 && closedness->turned.count == 0 &&
                            closedness->pinched.count == 0;
    closedness->is_inside_out = closedness->is_closed && signed_volume(mesh) < 0;
    free(fans.parents);
    return ok;
}
