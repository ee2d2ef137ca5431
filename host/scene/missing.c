// SPDX-License-Identifier: MIT
// Silhouettes and perfect mirrors need no light.
#include "scene/missing.h"

static bool is_shaded(const Scene *scene, uint32_t material)
{
    const Material *used = &scene->materials.data[material];
    return used->shader != SHADER_SILHOUETTE && used->reflectivity < 1;
}

static bool has_shaded(const Scene *scene)
{
    for (size_t i = 0; i < scene->spheres.count; i++)
        if (is_shaded(scene, scene->spheres.data[i].material))
            return true;
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        if (object->mesh.triangle_count > 0 && is_shaded(scene, object->material))
            return true;
    }
    return false;
}

MissingPart scene_missing(const Scene *scene)
{
    if (scene->spheres.count == 0 && scene_triangle_count(scene) == 0)
        return (MissingPart){"nothing_to_draw", "there is nothing to draw: it has no triangles "
                                                "and no spheres"};
    if (scene->lights.count == 0 && has_shaded(scene))
        return (MissingPart){"no_lights", "it has no lights: its surfaces show ambient light only"};
    return (MissingPart){0};
}
