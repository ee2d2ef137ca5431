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
    return (MeshLoadOptions){.object = {.material = 1, .two_sided = true},
                             .crease_degrees = CREASE_DEGREES,
                             .takes_own_materials = true,
                             .parse = parse};
}

// Adds cameras and lights to a scene of meshes. Frees the scene if ok is false or memory runs out.
static bool complete(Scene *scene, bool ok, Error *error)
{
    Vec3 center;
    const double radius = radius_of(scene, &center);
    scene->is_mesh = true;
    ok =
        ok && add_cameras(scene, center, radius, error) && add_lights(scene, center, radius, error);
    if (!ok)
        scene_free(scene);
    return ok;
}

bool mesh_scene_parse(Scene *scene, const File *file, const char *name, PlyParse *parse,
                      Error *error)
{
    const MeshLoadOptions options = options_of(parse);
    const double start = clock_seconds();
    const bool ok = scene_init(scene, error) && ply_mesh_add(scene, file, name, &options, error) &&
                    mesh_load_normals(scene, 0, &options, error);
    scene->mesh_seconds = clock_seconds() - start;
    return complete(scene, ok, error);
}

bool mesh_scene_read_foreign(Scene *scene, const char *path, PlyParse *parse, Error *error)
{
    const MeshLoadOptions options = options_of(parse);
    const double start = clock_seconds();
    const bool ok = scene_init(scene, error) && foreign_mesh_add(scene, path, &options, error) &&
                    mesh_load_normals(scene, 0, &options, error);
    scene->mesh_seconds = clock_seconds() - start;
    return complete(scene, ok, error);
}
