// SPDX-License-Identifier: MIT
// Bounding boxes of short runs of triangles, which let searches among vertices skip most of a mesh.
// Neighbors in a file are usually neighbors in space.
#pragma once

#include "scene/scene.h"

typedef struct {
    const Mesh *mesh;
    size_t first, end; // triangles
    Vec3 low, high;
} TriangleRun;

typedef struct {
    ARRAY(TriangleRun) runs;
    Vec3 low, high; // the whole box; all infinite without triangles
} TriangleRuns;

// Fills runs, which borrow the scene's meshes. The caller frees runs.memory, also on failure.
bool triangle_runs_make(TriangleRuns *runs, const Scene *scene, Error *error);

// Returns the vertex that lies farthest in a direction, of those that triangles use.
Vec3 triangle_runs_farthest(const TriangleRuns *runs, Vec3 direction);

static inline Vec3 triangle_corner(const Mesh *mesh, size_t triangle, int corner)
{
    const double *p = mesh->positions[mesh->triangles[triangle][corner]];
    return vec3(p[0], p[1], p[2]);
}
