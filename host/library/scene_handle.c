// SPDX-License-Identifier: MIT
// A ClrtScene is a Scene with a number for its state. Every change gives the scene a new number
// that no scene has had. Renderers compare the numbers to notice changes.
#include "base/limits.h"
#include "library/handles.h"

#include "scene/scn.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// No version of the library has a larger struct, so a larger size means that the caller has not
// initialized the member `size`.
#define LARGEST_STRUCT 4096

bool check_fail(ClrtError *error, ClrtFault fault, const char *format, ...)
{
    va_list arguments;
    if (error == NULL)
        return false;
    error->fault = fault;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    return false;
}

bool check_fail_for(ClrtError *error, ClrtFault fault, const Error *cause)
{
    return check_fail(error, fault, "%s", cause->text);
}

bool check_given(ClrtError *error, const char *what, const void *pointer)
{
    return pointer != NULL || check_fail(error, CLRT_ARGUMENT, "%s is NULL", what);
}

// NaN fails both comparisons.
bool check_number(ClrtError *error, const char *what, double number, double low, double high)
{
    return (number >= low && number <= high) ||
           check_fail(error, CLRT_ARGUMENT, "%s is %.10g, not between %g and %g", what, number, low,
                      high);
}

static bool check_three(ClrtError *error, const char *what, const double three[3], double low,
                        double high)
{
    for (int i = 0; i < 3; i++)
        if (!check_number(error, what, three[i], low, high))
            return false;
    return true;
}

bool check_vector(ClrtError *error, const char *what, const double vector[3], double most)
{
    return check_given(error, what, vector) && check_three(error, what, vector, -most, most);
}

bool check_color(ClrtError *error, const char *what, const double color[3])
{
    return check_given(error, what, color) && check_three(error, what, color, 0, 1);
}

// Returns whether all bytes are zero. Members that only later versions have must be zero, because
// this version can only apply their defaults.
static bool is_zero(const unsigned char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (bytes[i] != 0)
            return false;
    return true;
}

bool check_struct(ClrtError *error, const char *what, const void *given, void *copy, size_t size)
{
    size_t given_size;
    if (!check_given(error, what, given))
        return false;
    memcpy(&given_size, given, sizeof given_size);
    if (given_size < sizeof given_size || given_size > LARGEST_STRUCT)
        return check_fail(error, CLRT_ARGUMENT, "%s has a size of %zu, not %zu", what, given_size,
                          size);
    const size_t known = given_size < size ? given_size : size;
    memset(copy, 0, size);
    memcpy(copy, given, known);
    return is_zero((const unsigned char *)given + known, given_size - known) ||
           check_fail(error, CLRT_ARGUMENT, "%s sets members that libclrt %s does not know", what,
                      clrt_version());
}

bool fill_struct(ClrtError *error, const char *what, void *given, const void *filled, size_t size)
{
    size_t given_size;
    unsigned char unused[LARGEST_STRUCT];
    if (!check_struct(error, what, given, unused, size))
        return false;
    memcpy(&given_size, given, sizeof given_size);
    memcpy(given, filled, given_size < size ? given_size : size);
    memcpy(given, &given_size, sizeof given_size);
    return true;
}

// CMakeLists.txt defines the version.
const char *clrt_version(void)
{
    return CLRT_VERSION;
}

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
    return number < count ||
           check_fail(error, CLRT_ARGUMENT, "material %u does not exist: the scene has %zu", number,
                      count);
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
    if (!check_given(error, "the path", path) ||
        (load != NULL && !check_struct(error, "the load", load, &given, sizeof given)) ||
        !check_number(error, "the up axis", given.up, 0, CLRT_UP_MINUS_Z) ||
        !check_number(error, "the crease angle", given.crease_degrees, 0, CREASE_MOST))
        return NULL;
    if (given.flat && given.crease_degrees > 0) {
        check_fail(error, CLRT_ARGUMENT, "the mesh is flat and has a crease angle");
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
    if (!check_given(error, "the scene", scene))
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
    return fill_struct(error, "the info", info, &filled, sizeof filled);
}
