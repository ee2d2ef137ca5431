// SPDX-License-Identifier: MIT
// Places cameras and lights around the bounding sphere of the bounding box.
#include "scene/mesh_load.h"

#include "base/clock.h"

#include <string.h>

#define FOV_DEGREES 45

bool mesh_scene_is_mesh(const char *bytes, size_t size)
{
    return size >= 4 && memcmp(bytes, "ply", 3) == 0 && (bytes[3] == '\n' || bytes[3] == '\r');
}

// Returns half the diagonal of the bounding box, or 1 if it is zero. Stores the box's center in
// *center.
static double radius_of(const Scene *scene, Vec3 *center)
{
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t object = 0; object < scene->objects.count; object++)
        mesh_add_bounds(&scene->objects.data[object].mesh, &low, &high);
    if (scene_triangle_count(scene) == 0)
        low = high = vec3(0, 0, 0);
    *center = vec3_scale(vec3_add(low, high), 0.5);
    const Vec3 half = vec3_scale(vec3_sub(high, low), 0.5);
    const double radius = sqrt(vec3_dot(half, half));
    return radius > 0 ? radius : 1;
}

static bool add_cameras(Scene *scene, Vec3 center, double radius, Error *error)
{
    static const double directions[6][3] = {{2, -2.6, 1.4}, {0, -1, 0}, {1, 0, 0},
                                            {0, 1, 0},      {-1, 0, 0}, {0, 0, 1}};
    // 1 / sin(fov / 2), so that the bounding sphere touches the picture's upper and lower edges.
    const double distance = radius * 2.6131259297527532;
    for (int view = 0; view < 6; view++) {
        const double *d = directions[view];
        const Vec3 direction = vec3_normalize(vec3(d[0], d[1], d[2]));
        const Viewpoint viewpoint = {.eye = vec3_add(center, vec3_scale(direction, distance)),
                                     .look_at = center,
                                     .up = view == 5 ? vec3(0, 1, 0) : vec3(0, 0, 1),
                                     .fov_degrees = FOV_DEGREES};
        if (!array_push(&scene->viewpoints, viewpoint, error))
            return false;
    }
    return true;
}

static bool add_lights(Scene *scene, Vec3 center, double radius, Error *error)
{
    const Vec3 key = vec3_add(center, vec3_scale(vec3(5, -7, 8), radius));
    const Vec3 fill = vec3_add(center, vec3_scale(vec3(-8, 1, 6), radius));
    return array_push(&scene->lights, light_white(key, 0.7), error) &&
           array_push(&scene->lights, light_white(fill, 0.3), error);
}

// A mesh that replaces a scene file is visible from both sides.
static MeshLoadOptions options_of(PlyParse *parse)
{
    return (MeshLoadOptions){.object = {.material = 1, .two_sided = true, .smooth = true},
                             .takes_own_materials = true,
                             .parse = parse};
}

// Turns the meshes from their current up axis and adds cameras and lights. The hash records the
// axis, because parts of a picture must agree on it.
static bool turn_and_frame(Scene *scene, UpAxis up, Error *error)
{
    Vec3 center;
    for (size_t object = 0; object < scene->objects.count; object++) {
        mesh_turn_up(&scene->objects.data[object].mesh, up_axis_inverse(scene->mesh_up));
        mesh_turn_up(&scene->objects.data[object].mesh, up);
    }
    scene->mesh_up = up;
    scene_hash_input(scene, up_axis_names[up], strlen(up_axis_names[up]));
    scene->viewpoints.count = scene->lights.count = 0;
    const double radius = radius_of(scene, &center);
    return add_cameras(scene, center, radius, error) && add_lights(scene, center, radius, error);
}

bool mesh_scene_turn(Scene *scene, UpAxis up, Error *error)
{
    if (scene->mesh_up == UP_AUTO)
        return error_set(error,
                         "only a mesh without a scene can be turned: write 'up %s' in its "
                         "mesh statement",
                         up_axis_names[up]);
    return up == UP_AUTO || turn_and_frame(scene, up, error);
}

// Returns the up axis of the formats that have one, and UP_AUTO for the others. glTF, 3MF and AMF
// define theirs. Modeling programs write OBJ with y up, and Assimp turns formats of other
// programs so.
static UpAxis up_axis_of_format(const char *path)
{
    static const struct {
        const char *ending;
        UpAxis up;
    } formats[] = {
        {".ply", UP_AUTO}, {".stl", UP_AUTO}, {".off", UP_AUTO}, {".3mf", UP_Z}, {".amf", UP_Z}};
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (file_has_ending(path, formats[i].ending))
            return formats[i].up;
    return UP_Y;
}

// Completes a scene of meshes. Frees the scene if ok is false or memory runs out.
static bool complete(Scene *scene, bool ok, UpAxis up, Error *error)
{
    if (ok && up == UP_AUTO)
        up = up_axis_of_shape(scene);
    ok = ok && turn_and_frame(scene, up, error);
    if (!ok)
        scene_free(scene);
    return ok;
}

bool mesh_scene_parse(Scene *scene, const File *file, const char *name, PlyParse *parse,
                      Error *error)
{
    const MeshLoadOptions options = options_of(parse);
    const double start = clock_seconds();
    const bool ok = scene_init(scene, error) && ply_mesh_add(scene, file, name, &options, error);
    scene->mesh_seconds = clock_seconds() - start;
    return complete(scene, ok, UP_AUTO, error);
}

bool mesh_scene_read_foreign(Scene *scene, const char *path, PlyParse *parse, Error *error)
{
    const MeshLoadOptions options = options_of(parse);
    const double start = clock_seconds();
    const bool ok = scene_init(scene, error) && foreign_mesh_add(scene, path, &options, error);
    scene->mesh_seconds = clock_seconds() - start;
    return complete(scene, ok, up_axis_of_format(path), error);
}
