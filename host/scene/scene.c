// SPDX-License-Identifier: MIT
// Creates scenes with the constants of the UvA course "Graphics and Game Technology", and frees
// them. Combines hashes of a scene's files, finds missing objects or lights, and bounds the error
// that max_level causes.
#include "scene/scene.h"

#include "base/text.h"

#include <inttypes.h>
#include <search.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

// The kernels compute powers with integer exponents up to this limit by squaring, which gives the
// same bits on every device.
#define LARGEST_INTEGER_EXPONENT 1024

const char *const shader_names[] = {[SHADER_SILHOUETTE] = "silhouette",
                                    [SHADER_MATTE] = "matte",
                                    [SHADER_BLINN_PHONG] = "blinn_phong",
                                    [SHADER_GLASS] = "glass"};

Material material_of_shader(Shader shader)
{
    Material material = {.diffuse = {1, 1, 1}, .kd = 1, .shader = shader, .exponent = UINT32_MAX};
    if (shader == SHADER_GLASS)
        material.ior = 1.5f, material.reflectivity = 1;
    else if (shader != SHADER_MATTE)
        material.diffuse[1] = material.diffuse[2] = 0;
    if (shader == SHADER_BLINN_PHONG) {
        material.kd = 0.8f;
        material.ks = 0.5f;
        material.specular[0] = material.specular[1] = material.specular[2] = 1;
        material.shininess = 50;
        material.exponent = 50;
    }
    return material;
}

bool scene_init(Scene *scene, Error *error)
{
    *scene = (Scene){
        .background = {1, 1, 1}, .ambient = 0.05, .width = 512, .height = 512, .max_level = 3};
    Material mirror = material_of_shader(SHADER_MATTE);
    mirror.reflectivity = 0.25f;
    return array_push(&scene->materials, material_of_shader(SHADER_SILHOUETTE), error) &&
           array_push(&scene->materials, material_of_shader(SHADER_MATTE), error) &&
           array_push(&scene->materials, material_of_shader(SHADER_BLINN_PHONG), error) &&
           array_push(&scene->materials, mirror, error);
}

// Converts a viewpoint of the course's viewer program, which consists of two angles in degrees and
// the distance from the origin.
static Viewpoint course_viewpoint(double azimuth, double rotation, double distance)
{
    const double level = distance * cosine_of_degrees(azimuth);
    return (Viewpoint){.eye = {level * cosine_of_degrees(rotation),
                               level * sine_of_degrees(rotation),
                               -distance * sine_of_degrees(azimuth)},
                       .look_at = {0, 0, 0.5},
                       .up = {0, 0, 1},
                       .fov_degrees = 45};
}

bool scene_complete(Scene *scene, Error *error)
{
    static const double course[6][3] = {{-40, 25, 6.5}, {-27.5, -30.5, 2},  {-73.8, 37, 3.8},
                                        {46.2, 0, 6.2}, {-35, -187.2, 2.8}, {-80.3, 27, 1.1}};
    if (scene->viewpoints.count > 0)
        return true;
    scene->has_course_views = true;
    for (int view = 0; view < 6; view++) {
        const double *orbit = course[view];
        if (!array_push(&scene->viewpoints, course_viewpoint(orbit[0], orbit[1], orbit[2]), error))
            return false;
    }
    return true;
}

// The projections of the point lights onto each side of the area are evenly spaced. An object's
// edge parallel to a side therefore hides the point lights one by one, not row by row (Chiu,
// Shirley and Wang, "Multi-jittered sampling", 1994).
bool scene_add_area_light(Scene *scene, const Light *light, const LightArea *area, Error *error)
{
    const double cells = area->cells;
    const uint32_t count = area->cells * area->cells;
    Light point = *light;
    point.intensity /= cells * cells;
    const AreaLight whole = {*light, *area, scene->lights.count};
    if (!array_reserve(&scene->lights.memory, &scene->lights.capacity, scene->lights.count + count,
                       sizeof point, error) ||
        (count > 1 && !array_push(&scene->area_lights, whole, error)))
        return false;
    for (uint32_t i = 0; i < count; i++) {
        const double column = i % area->cells, row = i / area->cells;
        const double u = (column + (row + 0.5) / cells) / cells - 0.5;
        const double v = (row + (column + 0.5) / cells) / cells - 0.5;
        const Vec3 aside = vec3_add(vec3_scale(area->sides[0], u), vec3_scale(area->sides[1], v));
        point.position = vec3_add(light->position, aside);
        scene->lights.data[scene->lights.count++] = point;
    }
    return true;
}

const char *viewpoint_fault(const Viewpoint *viewpoint)
{
    const Vec3 forward = vec3_normalize(vec3_sub(viewpoint->look_at, viewpoint->eye));
    const Vec3 right = vec3_cross(forward, vec3_normalize(viewpoint->up));
    if (!(vec3_extent(forward) > 0))
        return "the camera looks at its own position";
    if (!(vec3_extent(right) > 1e-9))
        return fabs(forward.z) > 0.5
                   ? "the camera must not look along its 'up' vector: choose another, as 'up 0 1 0'"
                   : "the camera must not look along its 'up' vector: choose another, as 'up 0 0 "
                     "1'";
    return NULL;
}

static void mix(uint64_t hash[2], XXH128_hash_t input)
{
    const uint64_t chain[4] = {hash[0], hash[1], input.low64, input.high64};
    const XXH128_hash_t mixed = XXH3_128bits(chain, sizeof chain);
    hash[0] = mixed.low64;
    hash[1] = mixed.high64;
}

void scene_hash_input(Scene *scene, const void *bytes, size_t size)
{
    mix(scene->hash, XXH3_128bits(bytes, size));
}

void scene_hash_mesh(Scene *scene, const void *bytes, size_t size)
{
    const XXH128_hash_t input = XXH3_128bits(bytes, size);
    mix(scene->hash, input);
    mix(scene->mesh_hash, input);
}

void scene_hash_name(const uint64_t hash[2], char name[SCENE_HASH_SIZE])
{
    snprintf(name, SCENE_HASH_SIZE, "%016" PRIx64 "%016" PRIx64, hash[1], hash[0]);
}

bool scene_add_input(Scene *scene, const char *path, Error *error)
{
    char *copy = text_copy(path, error);
    if (copy != NULL && array_push(&scene->inputs, copy, error))
        return true;
    free(copy);
    return false;
}

bool scene_add_note(Scene *scene, const char *path, const char *text, Error *error)
{
    char *note = text_format(error, "%s: %s", path, text);
    if (note != NULL && array_push(&scene->notes, note, error)) {
        text_hide_controls(note);
        return true;
    }
    free(note);
    return false;
}

size_t scene_triangle_count(const Scene *scene)
{
    size_t count = 0;
    for (size_t object = 0; object < scene->objects.count; object++)
        count += scene->objects.data[object].mesh.triangle_count;
    return count;
}

size_t scene_dropped_count(const Scene *scene)
{
    size_t count = 0;
    for (size_t object = 0; object < scene->objects.count; object++)
        count += scene->objects.data[object].mesh.dropped.count;
    return count;
}

uint64_t scene_number_in_file(const MeshObject *object, size_t triangle)
{
    return object->number_before + mesh_original_number(&object->mesh, triangle);
}

void scene_free(Scene *scene)
{
    for (size_t object = 0; object < scene->objects.count; object++)
        mesh_free(&scene->objects.data[object].mesh);
    for (size_t input = 0; input < scene->inputs.count; input++)
        free(scene->inputs.data[input]);
    for (size_t note = 0; note < scene->notes.count; note++)
        free(scene->notes.data[note]);
    free(scene->inputs.memory);
    free(scene->notes.memory);
    free(scene->lights.memory);
    free(scene->area_lights.memory);
    free(scene->spheres.memory);
    free(scene->objects.memory);
    free(scene->materials.memory);
    material_names_free(&scene->material_names);
    free(scene->viewpoints.memory);
    *scene = (Scene){0};
}

void material_set_shininess(Material *material, float shininess)
{
    const bool by_squaring =
        shininess <= LARGEST_INTEGER_EXPONENT && shininess == floorf(shininess);
    material->shininess = shininess;
    material->exponent = by_squaring ? (uint32_t)shininess : UINT32_MAX;
}

// Returns the material of the next sphere or non-empty object, or NULL after the last one. *place
// must be 0 at the first call.
static const Material *next_used(const Scene *scene, size_t *place)
{
    const size_t spheres = scene->spheres.count;
    while (*place < spheres + scene->objects.count) {
        const size_t i = (*place)++;
        if (i < spheres)
            return &scene->materials.data[scene->spheres.data[i].material];
        const MeshObject *object = &scene->objects.data[i - spheres];
        if (object->mesh.triangle_count > 0)
            return &scene->materials.data[object->material];
    }
    return NULL;
}

// Returns whether any surface needs light. Silhouettes, glass and perfect mirrors need none.
static bool has_shaded(const Scene *scene)
{
    size_t place = 0;
    for (const Material *used; (used = next_used(scene, &place)) != NULL;)
        if (used->shader != SHADER_SILHOUETTE && used->reflectivity < 1)
            return true;
    return false;
}

static bool has_points(const Scene *scene)
{
    size_t object = 0;
    while (object < scene->objects.count && scene->objects.data[object].mesh.vertex_count == 0)
        object++;
    return object < scene->objects.count;
}

MissingPart scene_missing(const Scene *scene)
{
    const bool is_empty = scene->spheres.count == 0 && scene_triangle_count(scene) == 0;
    if (is_empty && scene_dropped_count(scene) == 0 && has_points(scene))
        return (MissingPart){"points_alone",
                             "there is nothing to draw: it has points and no triangles", true};
    if (is_empty)
        return (MissingPart){"nothing_to_draw",
                             "there is nothing to draw: it has no triangles and no spheres", false};
    if (scene->lights.count == 0 && has_shaded(scene))
        return (MissingPart){"no_lights", "it has no lights: its surfaces show ambient light only",
                             false};
    return (MissingPart){0};
}

bool scene_has_glass(const Scene *scene)
{
    size_t place = 0;
    for (const Material *used; (used = next_used(scene, &place)) != NULL;)
        if (used->shader == SHADER_GLASS)
            return true;
    return false;
}

uint32_t scene_level_limit(const Scene *scene)
{
    return scene_has_glass(scene) ? GLASS_LEVELS : MAX_LEVEL_LIMIT;
}

static double largest_reflectivity(const Scene *scene)
{
    size_t place = 0;
    double largest = 0;
    for (const Material *used; (used = next_used(scene, &place)) != NULL;)
        largest = fmax(largest, (double)used->reflectivity);
    return largest;
}

// The bound is largest_reflectivity ^ max_level, because the weight of a ray of level `max_level`
// is a product of max_level reflectivities.
double truncation_bound(const Scene *scene, uint32_t max_level)
{
    const double reflectivity = largest_reflectivity(scene);
    double weight = 1;
    for (uint32_t level = 0; level < max_level && weight > 0; level++)
        weight *= reflectivity;
    return weight;
}

uint32_t truncation_level(const Scene *scene, double bound)
{
    const double reflectivity = largest_reflectivity(scene);
    const uint32_t most = scene_level_limit(scene);
    double weight = 1;
    uint32_t level = 0;
    for (; level < most && weight > bound; level++)
        weight *= reflectivity;
    return level;
}

// The following functions find names in a balanced tree of the C library.

static int compare_names(const void *first, const void *second)
{
    const MaterialName *a = first, *b = second;
    return strcmp(a->name, b->name);
}

bool material_names_add(MaterialNames *names, const MaterialName *name, Error *error)
{
    MaterialName *held = memory_raw(1, sizeof *held, error);
    if (held == NULL || !array_push(&names->list, held, error)) {
        free(held);
        return false;
    }
    *held = *name;
    return tsearch(held, &names->tree, compare_names) != NULL ||
           error_out_of_memory(error, sizeof *held);
}

const MaterialName *material_names_find(const MaterialNames *names, const char *name, size_t length)
{
    MaterialName key = {0};
    if (length >= sizeof key.name)
        return NULL;
    memcpy(key.name, name, length);
    MaterialName *const *found = tfind(&key, &names->tree, compare_names);
    return found == NULL ? NULL : *found;
}

static void keep(void *name)
{
    (void)name; // the list owns it
}

void material_names_free(MaterialNames *names)
{
    tdestroy(names->tree, keep);
    for (size_t i = 0; i < names->list.count; i++)
        free(names->list.data[i]);
    free(names->list.memory);
    *names = (MaterialNames){0};
}
