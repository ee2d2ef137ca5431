// SPDX-License-Identifier: MIT
// Ownership of a mesh.
#include "scene/mesh.h"

#include <stdlib.h>

void mesh_free(Mesh *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->triangles);
    *mesh = (Mesh){0};
}
