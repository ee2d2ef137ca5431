// SPDX-License-Identifier: MIT
// Moves the mesh into the scene, or frees it.
#include "scene/ply_mesh.h"

bool ply_mesh_add(Scene *scene, const File *file, const char *path, const MeshOrder *order,
                  Error *error)
{
    MeshObject object = order->object;
    object.input = (uint32_t)scene->inputs.count;
    scene_hash_mesh(scene, file->bytes, file->size);
    const bool ok = order->parse(&object.mesh, file->bytes, file->size, path, error) &&
                    scene_add_input(scene, path, error) &&
                    array_push(&scene->objects, object, error);
    if (!ok)
        mesh_free(&object.mesh);
    return ok;
}
