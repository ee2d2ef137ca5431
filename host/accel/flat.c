// SPDX-License-Identifier: MIT
// Flattens a scene: everything but the triangles and their tree, which flat_pair.c and flat_wide.c
// lay out.
#include "accel/flat.h"

#include "accel/flat_pair.h"
#include "accel/flat_wide.h"

#include <stdlib.h>

static void split_float(double value, float *high, float *low)
{
    *high = (float)value;
    *low = (float)(value - (double)*high);
}

static void flatten_sphere(SphereData *data, const Sphere *sphere,
                           const Normalization *normalization)
{
    const Vec3 center = normalize_point(normalization, sphere->center);
    data->material = sphere->material;
    split_float(center.x, &data->center[0], &data->center_low[0]);
    split_float(center.y, &data->center[1], &data->center_low[1]);
    split_float(center.z, &data->center[2], &data->center_low[2]);
    split_float(sphere->radius * normalization->scale, &data->radius, &data->radius_low);
}

static void flatten_light(PointLight *data, const Light *light, const Normalization *normalization)
{
    const Vec3 position = normalize_point(normalization, light->position);
    data->position[0] = (float)position.x;
    data->position[1] = (float)position.y;
    data->position[2] = (float)position.z;
    data->intensity = (float)light->intensity;
}

static Vec3 mesh_corner(const Mesh *mesh, const uint32_t *triangle, int corner)
{
    const double *p = mesh->positions[triangle[corner]];
    return vec3(p[0], p[1], p[2]);
}

static Vec3 face_normal(const Mesh *mesh, const uint32_t *triangle)
{
    const Vec3 a = mesh_corner(mesh, triangle, 0);
    const Vec3 first = vec3_normalize(vec3_sub(mesh_corner(mesh, triangle, 1), a));
    const Vec3 second = vec3_normalize(vec3_sub(mesh_corner(mesh, triangle, 2), a));
    return vec3_normalize(vec3_cross(first, second));
}

static Vec3 corner_normal(const Mesh *mesh, const uint32_t *triangle, int corner)
{
    const float *n = mesh->normals[triangle[corner]];
    const Vec3 normal = {(double)n[0], (double)n[1], (double)n[2]};
    return vec3_extent(normal) > 0 ? normal : face_normal(mesh, triangle);
}

// The lengths of a triangle's normals weigh them against each other, so they are kept; a power of
// two common to the three keeps their squares in range.
static void flatten_normals(CornerNormals *data, const Mesh *mesh, const uint32_t *triangle)
{
    Vec3 normals[3];
    double extent = 0;
    for (int corner = 0; corner < 3; corner++) {
        normals[corner] = corner_normal(mesh, triangle, corner);
        extent = fmax(extent, vec3_extent(normals[corner]));
    }
    const double scale = extent > 0 ? scalbn(1, -ilogb(extent)) : 1;
    for (int corner = 0; corner < 3; corner++) {
        data->normals[corner][0] = (float)(normals[corner].x * scale);
        data->normals[corner][1] = (float)(normals[corner].y * scale);
        data->normals[corner][2] = (float)(normals[corner].z * scale);
    }
}

static bool object_is_smooth(const MeshObject *object)
{
    return object->smooth && object->mesh.normals != NULL;
}

// A look carries the mark of two-sided triangles until the layout moves it to its place.
static void flatten_object(FlatScene *flat, const MeshObject *object, TriangleLook *looks)
{
    for (size_t i = 0; i < object->mesh.triangle_count; i++) {
        looks[i].material = object->material | (object->two_sided ? TRIANGLE_TWO_SIDED : 0);
        looks[i].normals = NOTHING;
        if (!object_is_smooth(object))
            continue;
        looks[i].normals = flat->normals_count++;
        flatten_normals(&flat->normals[looks[i].normals], &object->mesh, object->mesh.triangles[i]);
    }
}

static size_t smooth_triangle_count(const Scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->objects.count; i++)
        if (object_is_smooth(&scene->objects.data[i]))
            count += scene->objects.data[i].mesh.triangle_count;
    return count;
}

static bool allocate(FlatScene *flat, const Scene *scene, Error *error)
{
    flat->light_count = (uint32_t)scene->lights.count;
    flat->material_count = (uint32_t)scene->materials.count;
    flat->sphere_count = (uint32_t)scene->spheres.count;
    flat->triangle_count = (uint32_t)scene_triangle_count(scene);
    flat->lights = memory_zeroed(flat->light_count, sizeof *flat->lights, error);
    flat->materials = memory_zeroed(flat->material_count, sizeof *flat->materials, error);
    flat->spheres = memory_zeroed(flat->sphere_count, sizeof *flat->spheres, error);
    flat->looks = memory_raw(flat->triangle_count, sizeof *flat->looks, error);
    flat->normals = memory_zeroed(smooth_triangle_count(scene), sizeof *flat->normals, error);
    return flat->lights != NULL && flat->materials != NULL && flat->spheres != NULL &&
           flat->looks != NULL && flat->normals != NULL;
}

static void flatten_constants(FlatScene *flat, const Scene *scene)
{
    flat->background[0] = (float)scene->background.x;
    flat->background[1] = (float)scene->background.y;
    flat->background[2] = (float)scene->background.z;
    flat->ambient = (float)scene->ambient;
    for (uint32_t i = 0; i < flat->material_count; i++)
        flat->materials[i] = scene->materials.data[i];
}

static void flatten_objects(FlatScene *flat, const Scene *scene)
{
    TriangleLook *next = flat->looks;
    for (size_t i = 0; i < scene->objects.count; i++) {
        flatten_object(flat, &scene->objects.data[i], next);
        next += scene->objects.data[i].mesh.triangle_count;
    }
}

bool flat_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    const Scene *scene = source->scene;
    const Normalization normalization = normalization_of(scene);
    *flat = (FlatScene){.layout = source->layout};
    if (!allocate(flat, scene, error)) {
        flat_free(flat);
        return false;
    }
    flatten_constants(flat, scene);
    for (uint32_t i = 0; i < flat->light_count; i++)
        flatten_light(&flat->lights[i], &scene->lights.data[i], &normalization);
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        flatten_sphere(&flat->spheres[i], &scene->spheres.data[i], &normalization);
    flatten_objects(flat, scene);
    if (source->layout == NODES_WIDE ? flat_wide_make(flat, source, error)
                                     : flat_pair_make(flat, source, error))
        return true;
    flat_free(flat);
    return false;
}

void flat_free(FlatScene *flat)
{
    free(flat->lights);
    free(flat->materials);
    free(flat->spheres);
    free(flat->pairs);
    free(flat->triangles);
    free(flat->wides);
    free(flat->blocks);
    free(flat->looks);
    free(flat->normals);
    *flat = (FlatScene){0};
}

size_t flat_size(const FlatScene *flat)
{
    const size_t common =
        flat->light_count * sizeof *flat->lights + flat->material_count * sizeof *flat->materials +
        flat->sphere_count * sizeof *flat->spheres + flat->normals_count * sizeof *flat->normals;
    if (flat->layout == NODES_WIDE)
        return common + flat->node_count * sizeof *flat->wides +
               flat->block_count * sizeof *flat->blocks +
               flat->triangle_count * sizeof *flat->looks;
    return common + flat->node_count * sizeof *flat->pairs +
           flat->triangle_count * sizeof *flat->triangles;
}
