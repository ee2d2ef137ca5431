// SPDX-License-Identifier: MIT
// Builds a small studio around the meshes: cameras, three lights and a floor.
#include "scene/mesh_load.h"

#include "base/clock.h"
#include "scene/scn.h"

#include <string.h>

static const char studio[] =
    "background 0.8 0.84 0.88\n"
    "ambient 0.27\n"
    "define clay blinn_phong diffuse 0.93 0.85 0.76 kd 1 ks 0.25 shininess 40\n"
    "define floor matte diffuse 0.82 0.86 0.9\n";

// A key light from the left, a fill light from the right and a rim light from behind, as seen by
// the first camera. Positions are relative to the meshes' center, in radii.
static const Light lights[3] = {{{-12, -26, 30}, 0.60, {1, 0.97, 0.92}},
                                {{26, -14, 18}, 0.20, {0.9, 0.95, 1}},
                                {{6, 16, 32}, 0.20, {1, 1, 1}}};

// In radii. The floor is the top of a sphere that is too large to look round.
#define FLOOR_RADIUS 1000

bool mesh_scene_is_mesh(const char *bytes, size_t size)
{
    return size >= 4 && memcmp(bytes, "ply", 3) == 0 && (bytes[3] == '\n' || bytes[3] == '\r');
}

static bool add_studio(Scene *scene, Error *error)
{
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t object = 0; object < scene->objects.count; object++)
        mesh_add_bounds(&scene->objects.data[object].mesh, &low, &high);
    const bool is_empty = scene_triangle_count(scene) == 0;
    if (is_empty)
        low = vec3(-1, -1, -1), high = vec3(1, 1, 1);
    const Vec3 half = vec3_scale(vec3_sub(high, low), 0.5), center = vec3_add(low, half);
    const double radius = sqrt(vec3_dot(half, half)), depth = FLOOR_RADIUS * radius;
    const Sphere floor = {vec3(center.x, center.y, low.z - depth), depth, MESH_FLOOR};
    scene->viewpoints.count = scene->lights.count = scene->spheres.count = 0;
    scene->has_course_views = false;
    bool ok = mesh_frame_add_views(scene, center, radius, error) &&
              (is_empty || array_push(&scene->spheres, floor, error));
    for (int i = 0; ok && i < 3; i++) {
        Light light = lights[i];
        light.position = vec3_add(center, vec3_scale(light.position, radius));
        ok = array_push(&scene->lights, light, error);
    }
    return ok;
}

// Turns from y and -y, and from x and -x, undo each other.
static UpAxis inverse_of(UpAxis up)
{
    return up == UP_AUTO || up == UP_Z || up == UP_MINUS_Z ? up : (up + 2) % UP_MINUS_Z + 1;
}

// Turns the meshes from their current up axis and adds the studio. The hash records the axis,
// because parts of a picture must agree on it.
static bool turn_and_frame(Scene *scene, UpAxis up, Error *error)
{
    for (size_t object = 0; object < scene->objects.count; object++) {
        mesh_turn_up(&scene->objects.data[object].mesh, inverse_of(scene->mesh_up));
        mesh_turn_up(&scene->objects.data[object].mesh, up);
    }
    scene->mesh_up = up;
    scene_hash_input(scene, up_axis_names[up], strlen(up_axis_names[up]));
    return add_studio(scene, error);
}

// Returns the up axis of the formats that have one, and UP_AUTO for the others. 3MF and AMF define
// z, and glTF y. Modeling programs write OBJ with y up, and Assimp turns other formats so.
static UpAxis up_axis_of_format(const char *path)
{
    if (file_has_ending(path, ".stl") || file_has_ending(path, ".off"))
        return UP_AUTO;
    return file_has_ending(path, ".3mf") || file_has_ending(path, ".amf") ? UP_Z : UP_Y;
}

// Completes a scene of meshes. Frees the scene if ok is false or memory runs out.
static bool complete(Scene *scene, bool ok, UpAxis up, Error *error)
{
    ok = ok && turn_and_frame(scene, up != UP_AUTO ? up : up_axis_of_shape(scene), error);
    if (!ok)
        scene_free(scene);
    return ok;
}

bool mesh_scene_load(Scene *scene, const File *ply, const char *path, PlyParse *parse, Error *error)
{
    const MeshLoadOptions options = {.object = {.material = MESH_CLAY, .two_sided = true},
                                     .crease_degrees = CREASE_DEGREES,
                                     .takes_own_materials = true,
                                     .parse = parse};
    const double start = clock_seconds();
    const bool ok = scn_parse(scene, studio, sizeof studio - 1, "", error) &&
                    (ply != NULL ? ply_mesh_add(scene, ply, path, &options, error)
                                 : foreign_mesh_add(scene, path, &options, error)) &&
                    mesh_load_normals(scene, 0, &options, error);
    scene->mesh_seconds = clock_seconds() - start;
    return complete(scene, ok, ply != NULL ? UP_AUTO : up_axis_of_format(path), error);
}

bool mesh_scene_turn(Scene *scene, UpAxis up, Error *error)
{
    const bool ok =
        up == UP_AUTO || scene->mesh_up != UP_AUTO ||
        error_set(
            error,
            "%s: only a mesh without a scene can be turned: write 'up %s' in its mesh statement",
            scene->inputs.data[scene->inputs.count - 1], up_axis_names[up]);
    return up == UP_AUTO || complete(scene, ok, up, error);
}
