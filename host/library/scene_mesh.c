// SPDX-License-Identifier: MIT
// The caller's arrays -> a mesh of a scene. The arrays are copied and checked.
#include "base/limits.h"
#include "library/handles.h"
#include "mesh/normals.h"

#include <string.h>

// Fails if the array has too many elements, or if it is NULL and `count` is not 0.
static bool check_array(const char *what, const void *array, size_t count, ClrtError *error)
{
    if (count > MESH_COUNT_MOST)
        return library_fail(error, CLRT_ARGUMENT, "the mesh has %zu %s, more than %zu", count, what,
                            (size_t)MESH_COUNT_MOST);
    return array != NULL || count == 0 ||
           library_fail(error, CLRT_ARGUMENT, "the mesh's %s are NULL", what);
}

static void *copy_array(const void *array, size_t count, size_t size, Error *cause)
{
    void *copy = memory_raw(count, size, cause);
    if (copy != NULL && count > 0)
        memcpy(copy, array, count * size);
    return copy;
}

static bool copy_mesh(Mesh *mesh, const ClrtMesh *given, Error *cause)
{
    const size_t vertices = given->vertex_count, triangles = given->triangle_count;
    *mesh = (Mesh){.vertex_count = vertices, .triangle_count = triangles};
    mesh->positions = copy_array(given->positions, vertices, sizeof *mesh->positions, cause);
    mesh->triangles = copy_array(given->triangles, triangles, sizeof *mesh->triangles, cause);
    if (given->normals != NULL)
        mesh->normals = copy_array(given->normals, vertices, sizeof *mesh->normals, cause);
    if (given->colors != NULL)
        mesh->colors = copy_array(given->colors, vertices, sizeof *mesh->colors, cause);
    return mesh->positions != NULL && mesh->triangles != NULL &&
           (mesh->normals != NULL || given->normals == NULL) &&
           (mesh->colors != NULL || given->colors == NULL);
}

static bool check_vertices(const Mesh *mesh, ClrtError *error)
{
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
        for (int axis = 0; axis < 3; axis++) {
            const double position = mesh->positions[vertex][axis];
            if (!(fabs(position) < COORDINATE_MOST))
                return library_fail(error, CLRT_ARGUMENT,
                                    "a coordinate of vertex %zu is %g, not below 1e30 in size",
                                    vertex, position);
            if (mesh->normals != NULL && !isfinite(mesh->normals[vertex][axis]))
                return library_fail(error, CLRT_ARGUMENT, "the normal of vertex %zu is not finite",
                                    vertex);
            if (mesh->colors != NULL &&
                !(mesh->colors[vertex][axis] >= 0 && mesh->colors[vertex][axis] <= 1))
                return library_fail(error, CLRT_ARGUMENT,
                                    "the color of vertex %zu is not in [0, 1]", vertex);
        }
    return true;
}

static bool check_triangles(const Mesh *mesh, ClrtError *error)
{
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++) {
            const uint32_t vertex = mesh->triangles[triangle][corner];
            if (vertex >= mesh->vertex_count)
                return library_fail(error, CLRT_ARGUMENT,
                                    "triangle %zu has vertex %u, but the mesh has %zu vertices",
                                    triangle, vertex, mesh->vertex_count);
        }
    return true;
}

static bool check_mesh(const ClrtScene *scene, const ClrtMesh *mesh, ClrtError *error)
{
    if (mesh->flat && mesh->smooth)
        return library_fail(error, CLRT_ARGUMENT, "the mesh is flat and smooth");
    if (!mesh->smooth && mesh->crease_degrees != 0)
        return library_fail(error, CLRT_ARGUMENT, "the mesh has a crease angle, but is not smooth");
    return argument_number(error, "the crease angle", mesh->crease_degrees, 0, CREASE_MOST) &&
           check_array("positions", mesh->positions, mesh->vertex_count, error) &&
           check_array("triangles", mesh->triangles, mesh->triangle_count, error) &&
           scene_handle_check_material(scene, mesh->material, error);
}

// Copies the arrays before it checks them, because other threads may change the originals.
static bool take_mesh(MeshObject *object, const ClrtMesh *given, ClrtError *error)
{
    Error cause = {0};
    *object =
        (MeshObject){.material = given->material, .input = NO_INPUT, .two_sided = given->two_sided};
    const bool copied =
        copy_mesh(&object->mesh, given, &cause) || library_fail_for(error, CLRT_SCENE, &cause);
    const bool ok =
        copied && check_vertices(&object->mesh, error) && check_triangles(&object->mesh, error);
    if (!ok)
        mesh_free(&object->mesh);
    else if (given->flat)
        mesh_drop_normals(&object->mesh);
    return ok;
}

bool clrt_scene_add_mesh(ClrtScene *scene, const ClrtMesh *mesh, ClrtError *error)
{
    ClrtMesh given;
    MeshObject object;
    Error cause = {0};
    if (!argument_given(error, "the scene", scene) ||
        !argument_struct(error, "the mesh", mesh, &given, sizeof given) ||
        !check_mesh(scene, &given, error) || !take_mesh(&object, &given, error))
        return false;
    const double crease = given.crease_degrees > 0 ? given.crease_degrees : CREASE_DEGREES;
    const bool ok = mesh_drop_triangles(&object.mesh, &cause) &&
                    (!given.smooth || mesh_compute_normals(&object.mesh, crease, &cause)) &&
                    array_push(&scene->scene.objects, object, &cause);
    if (!ok)
        mesh_free(&object.mesh);
    return scene_handle_changed(scene, ok, &cause, error);
}
