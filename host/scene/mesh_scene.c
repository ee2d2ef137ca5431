// SPDX-License-Identifier: MIT
// Builds a photographer's studio around the meshes: cameras, three lights and a floor.
#include "scene/mesh_load.h"

#include "base/clock.h"
#include "scene/mesh_frame.h"

#include <stdlib.h>
#include <string.h>

bool mesh_scene_is_mesh(const char *bytes, size_t size)
{
    return size >= 4 && memcmp(bytes, "ply", 3) == 0 && (bytes[3] == '\n' || bytes[3] == '\r');
}

static bool find_place(MeshPlace *place, const Scene *scene, Error *error)
{
    if (!triangle_runs_make(&place->runs, scene, error))
        return false;
    const bool is_empty = place->runs.runs.count == 0;
    const Vec3 low = is_empty ? vec3(0, 0, 0) : place->runs.low;
    const Vec3 high = is_empty ? vec3(0, 0, 0) : place->runs.high;
    const Vec3 half = vec3_scale(vec3_sub(high, low), 0.5);
    const double radius = sqrt(vec3_dot(half, half));
    place->center = vec3_add(low, half);
    place->radius = radius > 0 ? radius : 1;
    return true;
}

static bool add_material(Scene *scene, MaterialName name, Material material, Error *error)
{
    name.material = (uint32_t)scene->materials.count;
    return array_push(&scene->material_names, name, error) &&
           array_push(&scene->materials, material, error);
}

static bool add_materials(Scene *scene, Error *error)
{
    Material clay = material_of_shader(SHADER_BLINN_PHONG);
    clay.diffuse[0] = 0.93f, clay.diffuse[1] = 0.85f, clay.diffuse[2] = 0.76f;
    clay.kd = 1;
    clay.ks = 0.25f;
    material_set_shininess(&clay, 40);
    Material floor = material_of_shader(SHADER_MATTE);
    floor.diffuse[0] = 0.82f, floor.diffuse[1] = 0.86f, floor.diffuse[2] = 0.90f;
    return add_material(scene, (MaterialName){.name = "clay"}, clay, error) &&
           add_material(scene, (MaterialName){.name = "floor"}, floor, error);
}

// Adds a key light from the left, a fill light from the right and a rim light from behind, as seen
// by the first camera.
static bool add_lights(Scene *scene, const MeshPlace *place, Error *error)
{
    static const Light lights[3] = {{{-12, -26, 30}, 0.60, {1, 0.97, 0.92}},
                                    {{26, -14, 18}, 0.20, {0.9, 0.95, 1}},
                                    {{6, 16, 32}, 0.20, {1, 1, 1}}};
    for (int i = 0; i < 3; i++) {
        Light light = lights[i];
        light.position = vec3_add(place->center, vec3_scale(light.position, place->radius));
        if (!array_push(&scene->lights, light, error))
            return false;
    }
    return true;
}

// Adds the top of a sphere that is too large to look round.
static bool add_floor(Scene *scene, const MeshPlace *place, Error *error)
{
    const double radius = 1000 * place->radius;
    const Sphere floor = {vec3(place->center.x, place->center.y, place->runs.low.z - radius),
                          radius, MESH_FLOOR};
    return scene_triangle_count(scene) == 0 || array_push(&scene->spheres, floor, error);
}

static bool add_studio(Scene *scene, Error *error)
{
    MeshPlace place = {0};
    scene->background = vec3(0.80, 0.84, 0.88);
    scene->ambient = 0.27;
    scene->viewpoints.count = scene->lights.count = scene->spheres.count = 0;
    const bool ok = find_place(&place, scene, error) &&
                    mesh_frame_add_views(scene, &place, error) &&
                    add_lights(scene, &place, error) && add_floor(scene, &place, error);
    free(place.runs.runs.memory);
    return ok;
}

// A mesh that replaces a scene file is visible from both sides.
static MeshLoadOptions options_of(PlyParse *parse)
{
    return (MeshLoadOptions){.object = {.material = MESH_CLAY, .two_sided = true, .smooth = true},
                             .takes_own_materials = true,
                             .parse = parse};
}

// Turns the meshes from their current up axis and adds cameras and lights. The hash records the
// axis, because parts of a picture must agree on it.
static bool turn_and_frame(Scene *scene, UpAxis up, Error *error)
{
    for (size_t object = 0; object < scene->objects.count; object++) {
        mesh_turn_up(&scene->objects.data[object].mesh, up_axis_inverse(scene->mesh_up));
        mesh_turn_up(&scene->objects.data[object].mesh, up);
    }
    scene->mesh_up = up;
    scene_hash_input(scene, up_axis_names[up], strlen(up_axis_names[up]));
    return add_studio(scene, error);
}

bool mesh_scene_turn(Scene *scene, UpAxis up, Error *error)
{
    if (!scene_is_mesh(scene))
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
    ok = ok && (up != UP_AUTO || up_axis_of_shape(&up, scene, error)) &&
         turn_and_frame(scene, up, error);
    if (!ok)
        scene_free(scene);
    return ok;
}

bool mesh_scene_parse(Scene *scene, const File *file, const char *name, PlyParse *parse,
                      Error *error)
{
    const MeshLoadOptions options = options_of(parse);
    const double start = clock_seconds();
    const bool ok = scene_init(scene, error) && add_materials(scene, error) &&
                    ply_mesh_add(scene, file, name, &options, error);
    scene->mesh_seconds = clock_seconds() - start;
    return complete(scene, ok, UP_AUTO, error);
}

bool mesh_scene_read_foreign(Scene *scene, const char *path, PlyParse *parse, Error *error)
{
    const MeshLoadOptions options = options_of(parse);
    const double start = clock_seconds();
    const bool ok = scene_init(scene, error) && add_materials(scene, error) &&
                    foreign_mesh_add(scene, path, &options, error);
    scene->mesh_seconds = clock_seconds() - start;
    return complete(scene, ok, up_axis_of_format(path), error);
}
