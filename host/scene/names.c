// SPDX-License-Identifier: MIT
// Primitive ids number the spheres first, then the triangles, mesh by mesh.
#include "scene/names.h"

#include <assert.h>

PrimitiveName name_primitive(const Scene *scene, uint32_t id)
{
    if (id < scene->spheres.count)
        return (PrimitiveName){.is_sphere = true, .number = (size_t)id + 1};
    size_t number = id - scene->spheres.count, object = 0;
    while (number >= scene->objects.data[object].mesh.triangle_count) {
        number -= scene->objects.data[object++].mesh.triangle_count;
        assert(object < scene->objects.count);
    }
    const MeshObject *found = &scene->objects.data[object];
    return (PrimitiveName){.number = number + found->number_before,
                           .path = scene->inputs.data[found->input]};
}

const char *name_material(const Scene *scene, uint32_t material)
{
    static const char *const courses[] = {"0", "1", "2", "3"};
    for (size_t i = 0; i < scene->material_names.count; i++)
        if (scene->material_names.data[i].material == material)
            return scene->material_names.data[i].name;
    assert(material < sizeof courses / sizeof *courses);
    return courses[material];
}
