// SPDX-License-Identifier: MIT
// Normalizes every corner in fp64 and rounds once.
#include "accel/triangles.h"

#include <stdlib.h>

static void store_corner(float corner[3], const double *position,
                         const Normalization *normalization)
{
    const Vec3 p = normalize_point(normalization, vec3(position[0], position[1], position[2]));
    corner[0] = (float)p.x;
    corner[1] = (float)p.y;
    corner[2] = (float)p.z;
}

static void store_mesh(float (*corners)[3][3], const Mesh *mesh, const Normalization *normalization)
{
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            store_corner(corners[triangle][corner],
                         mesh->positions[mesh->triangles[triangle][corner]], normalization);
}

bool triangles_make(Triangles *triangles, const Scene *scene, const Normalization *normalization,
                    Error *error)
{
    const size_t count = scene_triangle_count(scene);
    // Ids share 32 bits with the spheres', and children on the traversal stack take one of them.
    if (count + scene->spheres.count >= 0x7fffffff)
        return error_set(error, "the scene has %zu triangles, more than 2^31 primitives", count);
    triangles->corners = memory_raw(count, sizeof *triangles->corners, error);
    if (triangles->corners == NULL)
        return false;
    for (size_t i = 0; i < scene->objects.count; i++) {
        const Mesh *mesh = &scene->objects.data[i].mesh;
        store_mesh(triangles->corners + triangles->count, mesh, normalization);
        triangles->count += mesh->triangle_count;
    }
    return true;
}

void triangles_free(Triangles *triangles)
{
    free(triangles->corners);
    *triangles = (Triangles){0};
}
