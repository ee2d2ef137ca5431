// SPDX-License-Identifier: MIT
// A ClrtScene is a Scene with a number for its state. Every change gives the scene a new number
// that no scene has had. Renderers compare the numbers to notice changes.
#include "base/limits.h"
#include "library/handles.h"

#include "scene/scn.h"

#include <stdatomic.h>
#include <stdlib.h>

// CMakeLists.txt defines the version.
const char *clrt_version(void)
{
    return CLRT_VERSION;
}

bool scene_handle_changed(ClrtScene *scene, bool ok, const Error *cause, ClrtError *error)
{
    static atomic_uint_fast64_t last_state;
    if (!ok)
        return library_fail_for(error, CLRT_SCENE, cause);
    scene->state = atomic_fetch_add(&last_state, 1) + 1;
    return true;
}

bool scene_handle_check_material(const ClrtScene *scene, uint32_t number, ClrtError *error)
{
    const size_t count = scene->scene.materials.count;
    return number < count ||
           library_fail(error, CLRT_ARGUMENT, "material %u does not exist: the scene has %zu",
                        number, count);
}

// Returns a scene read from the file at `path` or, if `path` is NULL, an empty scene. Returns NULL
// on failure.
static ClrtScene *make(const char *path, const SceneLoadOptions *load, ClrtError *error)
{
    Error cause = {0};
    ClrtScene *scene = memory_zeroed(1, sizeof *scene, &cause);
    const bool ok = scene != NULL && (path != NULL ? scn_load(&scene->scene, path, load, &cause)
                                                   : scene_init(&scene->scene, &cause));
    if (scene_handle_changed(scene, ok, &cause, error))
        return scene;
    clrt_scene_free(scene);
    return NULL;
}

ClrtScene *clrt_scene_load(const char *path, const ClrtLoad *load, ClrtError *error)
{
    ClrtLoad given = {.size = sizeof given};
    if (!argument_given(error, "the path", path) ||
        (load != NULL && !argument_struct(error, "the load", load, &given, sizeof given)) ||
        !argument_number(error, "the up axis", given.up, 0, CLRT_UP_MINUS_Z) ||
        !argument_number(error, "the crease angle", given.crease_degrees, 0, CREASE_MOST))
        return NULL;
    if (given.flat && given.crease_degrees > 0) {
        library_fail(error, CLRT_ARGUMENT, "the mesh is flat and has a crease angle");
        return NULL;
    }
    const Normals computed = given.crease_degrees > 0 ? NORMALS_SMOOTH : NORMALS_AUTO;
    const SceneLoadOptions options = {.up = (UpAxis)given.up,
                                      .normals = given.flat ? NORMALS_FLAT : computed,
                                      .crease_degrees = given.crease_degrees,
                                      .studio = given.soft ? STUDIO_SOFT : STUDIO_HARD};
    return make(path, &options, error);
}

ClrtScene *clrt_scene_create(ClrtError *error)
{
    return make(NULL, NULL, error);
}

void clrt_scene_free(ClrtScene *scene)
{
    if (scene == NULL)
        return;
    scene_free(&scene->scene);
    free(scene);
}

bool clrt_scene_get_info(const ClrtScene *scene, ClrtSceneInfo *info, ClrtError *error)
{
    if (!argument_given(error, "the scene", scene))
        return false;
    const Scene *inside = &scene->scene;
    const ClrtSceneInfo filled = {.width = inside->width,
                                  .height = inside->height,
                                  .max_level = inside->max_level,
                                  .view_count = (uint32_t)inside->viewpoints.count,
                                  .light_count = (uint32_t)inside->lights.count,
                                  .material_count = (uint32_t)inside->materials.count,
                                  .sphere_count = (uint32_t)inside->spheres.count,
                                  .triangle_count = scene_triangle_count(inside),
                                  .dropped_triangle_count = scene_dropped_count(inside)};
    return argument_fill(error, "the info", info, &filled, sizeof filled);
}
