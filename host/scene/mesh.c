// SPDX-License-Identifier: MIT
// Ownership and bounds of a mesh.
#include "scene/mesh.h"

#include <stdlib.h>

void mesh_add_bounds(const Mesh *mesh, Vec3 *low, Vec3 *high)
{
    Vec3 least = *low, most = *high;
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++) {
            const double *p = mesh->positions[mesh->triangles[triangle][corner]];
            least = vec3_lower(least, vec3(p[0], p[1], p[2]));
            most = vec3_upper(most, vec3(p[0], p[1], p[2]));
        }
    *low = least;
    *high = most;
}

void mesh_free(Mesh *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->triangles);
    *mesh = (Mesh){0};
}
