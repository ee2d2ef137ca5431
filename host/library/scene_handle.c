// SPDX-License-Identifier: MIT
// A ClrtScene is a Scene with a state number. Every change gives the scene a new, higher number.
#include "library/scene_handle.h"

#include "library/check.h"
#include "scene/scn.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

bool scene_handle_changed(ClrtScene *scene, bool ok, const Error *cause, ClrtError *error)
{
    static atomic_uint_fast64_t last_state;
    if (!ok)
        return check_fail_for(error, CLRT_SCENE, cause);
    scene->state = atomic_fetch_add(&last_state, 1) + 1;
    return true;
}

bool scene_handle_check_material(const ClrtScene *scene, uint32_t number, ClrtError *error)
{
    const size_t count = scene->scene.materials.count;
    return number < count || check_fail(error, CLRT_ARGUMENT,
                                        "material %u is not among the scene's %zu", number, count);
}

// Returns a new scene, read from path or empty if path is NULL. Returns NULL on failure.
static ClrtScene *make(const char *path, ClrtError *error)
{
    Error cause = {0};
    ClrtScene *scene = memory_zeroed(1, sizeof *scene, &cause);
    const bool ok =
        scene != NULL && (path != NULL ? scn_load(&scene->scene, path, ply_parse, &cause)
                                       : scene_init(&scene->scene, &cause));
    if (scene_handle_changed(scene, ok, &cause, error))
        return scene;
    clrt_scene_free(scene);
    return NULL;
}

ClrtScene *clrt_scene_load(const char *path, ClrtError *error)
{
    return check_given(error, "the path", path) ? make(path, error) : NULL;
}

ClrtScene *clrt_scene_create(ClrtError *error)
{
    return make(NULL, error);
}

void clrt_scene_free(ClrtScene *scene)
{
    if (scene == NULL)
        return;
    scene_free(&scene->scene);
    free(scene);
}

static uint64_t dropped_count(const Scene *scene)
{
    uint64_t count = 0;
    for (size_t object = 0; object < scene->objects.count; object++)
        count += scene->objects.data[object].mesh.dropped_count;
    return count;
}

bool clrt_scene_get_info(const ClrtScene *scene, ClrtSceneInfo *info, ClrtError *error)
{
    ClrtSceneInfo filled;
    if (!check_given(error, "the scene", scene) ||
        !check_struct(error, "the info", info, &filled, sizeof filled))
        return false;
    const Scene *inside = &scene->scene;
    filled = (ClrtSceneInfo){.size = filled.size,
                             .width = inside->width,
                             .height = inside->height,
                             .max_level = inside->max_level,
                             .view_count = (uint32_t)inside->viewpoints.count,
                             .light_count = (uint32_t)inside->lights.count,
                             .material_count = (uint32_t)inside->materials.count,
                             .sphere_count = (uint32_t)inside->spheres.count,
                             .triangle_count = scene_triangle_count(inside),
                             .dropped_triangle_count = dropped_count(inside)};
    memcpy(info, &filled, filled.size < sizeof filled ? filled.size : sizeof filled);
    return true;
}
