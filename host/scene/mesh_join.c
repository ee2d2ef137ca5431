// SPDX-License-Identifier: MIT
// Joins meshes with one allocation per array.
#include "scene/scn.h"

#include "base/array.h"
#include "base/limits.h"

#include <string.h>

static bool allocate(Mesh *mesh, const Scene *scene, Error *error)
{
    bool has_normals = false;
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        mesh->vertex_count += object->mesh.vertex_count;
        mesh->triangle_count += object->mesh.triangle_count;
        has_normals |= object->mesh.normals != NULL;
    }
    if (mesh->vertex_count > (size_t)MESH_COUNT_MOST ||
        mesh->triangle_count > (size_t)MESH_COUNT_MOST)
        return error_set(error, "its %zu vertices or %zu triangles are too many for one mesh",
                         mesh->vertex_count, mesh->triangle_count);
    mesh->positions = memory_raw(mesh->vertex_count, sizeof *mesh->positions, error);
    mesh->triangles = memory_raw(mesh->triangle_count, sizeof *mesh->triangles, error);
    if (has_normals)
        mesh->normals = memory_zeroed(mesh->vertex_count, sizeof *mesh->normals, error);
    return mesh->positions != NULL && mesh->triangles != NULL &&
           (mesh->normals != NULL || !has_normals);
}

static void copy(Mesh *mesh, const MeshObject *object, size_t vertex, size_t triangle)
{
    const Mesh *part = &object->mesh;
    for (size_t i = 0; i < part->vertex_count; i++)
        memcpy(mesh->positions[vertex + i], part->positions[i], sizeof *part->positions);
    for (size_t i = 0; part->normals != NULL && i < part->vertex_count; i++)
        memcpy(mesh->normals[vertex + i], part->normals[i], sizeof *part->normals);
    for (size_t i = 0; i < part->triangle_count; i++)
        for (int corner = 0; corner < 3; corner++)
            mesh->triangles[triangle + i][corner] = (uint32_t)vertex + part->triangles[i][corner];
}

bool mesh_join(Mesh *mesh, const Scene *scene, Error *error)
{
    size_t vertex = 0, triangle = 0;
    *mesh = (Mesh){0};
    if (!allocate(mesh, scene, error)) {
        mesh_free(mesh);
        return false;
    }
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        copy(mesh, object, vertex, triangle);
        vertex += object->mesh.vertex_count;
        triangle += object->mesh.triangle_count;
    }
    return true;
}
