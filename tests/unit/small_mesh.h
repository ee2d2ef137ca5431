// SPDX-License-Identifier: MIT
// Small meshes for tests of computed normals.
#pragma once

#include "base/array.h"
#include "mesh/normals.h"

#include "unit/cmocka_all.h"

#include <string.h>

#define PI      3.14159265358979323846
#define DEGREES (180 / PI)

// Returns a mesh of this size. The caller sets the vertices and triangles.
static inline Mesh new_mesh(size_t vertices, size_t triangles)
{
    Error error = {0};
    Mesh mesh = {.vertex_count = vertices, .triangle_count = triangles};
    mesh.positions = memory_zeroed(vertices, sizeof *mesh.positions, &error);
    mesh.triangles = memory_zeroed(triangles, sizeof *mesh.triangles, &error);
    assert_true(mesh.positions != NULL && mesh.triangles != NULL);
    return mesh;
}

static inline void set_vertex(Mesh *mesh, uint32_t vertex, double x, double y, double z)
{
    const double position[3] = {x, y, z};
    memcpy(mesh->positions[vertex], position, sizeof position);
}

// Returns the same triangles without shared vertices, as an STL file has them.
static inline Mesh soup_of(const Mesh *mesh)
{
    Mesh soup = new_mesh(3 * mesh->triangle_count, mesh->triangle_count);
    for (uint32_t corner = 0; corner < 3 * mesh->triangle_count; corner++) {
        memcpy(soup.positions[corner], mesh->positions[mesh->triangles[corner / 3][corner % 3]],
               sizeof *soup.positions);
        soup.triangles[corner / 3][corner % 3] = corner;
    }
    return soup;
}

static inline void compute(Mesh *mesh, double crease_degrees)
{
    Error error = {0};
    if (!mesh_compute_normals(mesh, crease_degrees, &error))
        fail_msg("%s", error.text);
}

static inline Vec3 normal_at(const Mesh *mesh, size_t triangle, int corner)
{
    const float *n = mesh->normals[mesh->triangles[triangle][corner]];
    return vec3((double)n[0], (double)n[1], (double)n[2]);
}

static inline Vec3 position_at(const Mesh *mesh, size_t triangle, int corner)
{
    const double *p = mesh->positions[mesh->triangles[triangle][corner]];
    return vec3(p[0], p[1], p[2]);
}

static inline void expect_same_normals(const Mesh *a, const Mesh *b)
{
    assert_int_equal(a->triangle_count, b->triangle_count);
    for (size_t triangle = 0; triangle < a->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            assert_memory_equal(a->normals[a->triangles[triangle][corner]],
                                b->normals[b->triangles[triangle][corner]], sizeof *a->normals);
}
