// SPDX-License-Identifier: MIT
// Reports only the first object that has triangles without area.
#include "check/bad_geometry.h"

#include "check/features.h"

static MeshFault flat_triangles(const Mesh *mesh)
{
    MeshFault flat = {0};
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        if (features_is_flat(mesh, triangle))
            mesh_fault_add(&flat, triangle);
    return flat;
}

bool bad_geometry_none_dropped(const Scene *scene, Error *error)
{
    for (size_t object = 0; object < scene->objects.count; object++) {
        const MeshObject *owner = &scene->objects.data[object];
        const MeshFault *equal = &owner->mesh.equal_corners;
        if (equal->count > 0)
            return error_set(error,
                             "%s: triangle %zu, the first of %zu such, has two equal corners and "
                             "is left out",
                             scene->inputs.data[owner->input], equal->first + owner->number_before,
                             equal->count);
    }
    return true;
}

bool bad_geometry_none(const Scene *scene, Error *error)
{
    for (size_t object = 0; object < scene->objects.count; object++) {
        const MeshObject *owner = &scene->objects.data[object];
        const char *path = scene->inputs.data[owner->input];
        const MeshFault *equal = &owner->mesh.equal_corners;
        if (equal->count > 0)
            return error_set(error,
                             "%s: triangle %zu, the first of %zu such, has two equal corners", path,
                             equal->first + owner->number_before, equal->count);
        const MeshFault flat = flat_triangles(&owner->mesh);
        if (flat.count > 0)
            return error_set(error,
                             "%s: triangle %zu, the first of %zu such, has its corners on a line",
                             path, flat.first + owner->number_before, flat.count);
    }
    return true;
}
