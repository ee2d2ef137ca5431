// SPDX-License-Identifier: MIT
// Converts lights, materials, spheres and the shading data of triangles (TriangleLook) to the
// device's layout. flat_nodes.c converts the triangles and their tree.
#include "accel/flat.h"

#include "accel/flat_nodes.h"
#include "accel/sphere_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// flat_looks_make processes one mesh object at a time, and divides its triangles among the threads.

typedef struct {
    const Mesh *mesh;
    uint32_t material;      // with TRIANGLE_TWO_SIDED if the triangles are two-sided
    const uint8_t *orders;  // the object's section of Triangles::orders
    TriangleLook *looks;    // the object's section of FlatScene::looks
    CornerNormals *normals; // its section of FlatScene::normals; NULL for flat shading
    uint32_t first_normals; // index in FlatScene::normals of the section's first element
    CornerColors *colors;   // its section of FlatScene::colors; NULL without colors
    uint32_t first_colors;
} ObjectLooks;

static Vec3 face_normal(const Mesh *mesh, const uint32_t *triangle)
{
    const Vec3 first = mesh_direction(mesh, triangle[0], triangle[1]);
    const Vec3 second = mesh_direction(mesh, triangle[0], triangle[2]);
    return vec3_normalize(vec3_cross(first, second));
}

static Vec3 corner_normal(const Mesh *mesh, const uint32_t *triangle, int corner)
{
    const Vec3 normal = vec3_of_floats(mesh->normals[triangle[corner]]);
    return vec3_dot(normal, normal) > 0 ? normal : face_normal(mesh, triangle);
}

// Replaces fmax, which would be a function call.
static double larger(double a, double b)
{
    return a > b ? a : b;
}

// Returns 2^-floor(log2(value)) for values in [2^-1022, 2^1023). This is faster than ilogb and
// scalbn.
static double inverse_power(double value)
{
    uint64_t bits;
    double power;
    memcpy(&bits, &value, sizeof bits);
    bits = (2046 - (bits >> 52)) << 52;
    memcpy(&power, &bits, sizeof power);
    return power;
}

// Stores a triangle's normals, negated if the stored corners are reversed. Scales the three normals
// by one power of two, so that the largest component is in [1, 2). Squares of tiny or huge normals
// then neither vanish nor overflow. The factor is common to the three normals, so interpolation
// still weights them by their lengths.
static void store_normals(CornerNormals *data, const Mesh *mesh, const uint32_t *triangle,
                          const CornerOrder *order)
{
    Vec3 normals[3];
    double extent = 0;
    for (int corner = 0; corner < 3; corner++) {
        normals[corner] = corner_normal(mesh, triangle, order->places[corner]);
        extent = larger(extent, larger(fabs(normals[corner].x),
                                       larger(fabs(normals[corner].y), fabs(normals[corner].z))));
    }
    const double scale = (order->reversed ? -1 : 1) * (extent > 0 ? inverse_power(extent) : 1);
    for (int corner = 0; corner < 3; corner++) {
        vec3_store(data->normals[corner], vec3_scale(normals[corner], scale));
        data->normals[corner][3] = 0;
    }
}

static void store_colors(CornerColors *data, const Mesh *mesh, const uint32_t *triangle,
                         const CornerOrder *order)
{
    for (int corner = 0; corner < 3; corner++)
        memcpy(data->colors[corner], mesh->colors[triangle[order->places[corner]]],
               sizeof data->colors[corner]);
}

static void make_chunk(void *context, uint32_t first, uint32_t end)
{
    const ObjectLooks *looks = context;
    const Mesh *mesh = looks->mesh;
    const bool smooth = looks->normals != NULL, colored = looks->colors != NULL;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t *triangle = mesh->triangles[i];
        const CornerOrder *order = &corner_orders[looks->orders[i]];
        looks->looks[i].material = looks->material | (order->reversed ? TRIANGLE_REVERSED : 0);
        looks->looks[i].shading = smooth ? looks->first_normals + i : NOTHING;
        if (smooth)
            store_normals(&looks->normals[i], mesh, triangle, order);
        if (!colored)
            continue;
        store_colors(&looks->colors[i], mesh, triangle, order);
        looks->colors[i].shading = looks->looks[i].shading;
        looks->looks[i].shading = (looks->first_colors + i) | TRIANGLE_COLORED;
    }
}

static bool allocate_looks(FlatScene *flat, const Scene *scene, Error *error)
{
    size_t smooth = 0, colored = 0;
    for (size_t i = 0; i < scene->objects.count; i++) {
        const Mesh *mesh = &scene->objects.data[i].mesh;
        smooth += mesh->normals != NULL ? mesh->triangle_count : 0;
        colored += mesh->colors != NULL ? mesh->triangle_count : 0;
    }
    flat->looks = memory_raw(flat->triangle_count, sizeof *flat->looks, error);
    flat->normals = memory_raw(smooth, sizeof *flat->normals, error);
    flat->colors = memory_raw(colored, sizeof *flat->colors, error);
    return flat->looks != NULL && flat->normals != NULL && flat->colors != NULL;
}

static bool flat_looks_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    const Scene *scene = source->scene;
    size_t first = 0;
    if (!allocate_looks(flat, scene, error))
        return false;
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        const uint32_t count = (uint32_t)object->mesh.triangle_count;
        const bool smooth = object->mesh.normals != NULL, colored = object->mesh.colors != NULL;
        const bool is_glass = scene->materials.data[object->material].shader == SHADER_GLASS;
        const bool two_sided = object->two_sided || is_glass || source->is_two_sided;
        ObjectLooks looks = {&object->mesh,
                             object->material | (two_sided ? TRIANGLE_TWO_SIDED : 0),
                             source->triangles->orders + first,
                             flat->looks + first,
                             smooth ? flat->normals + flat->normals_count : NULL,
                             flat->normals_count,
                             colored ? flat->colors + flat->colors_count : NULL,
                             flat->colors_count};
        thread_pool_share(source->pool, count, CHUNK_ELEMENTS, make_chunk, &looks);
        first += count;
        flat->normals_count += smooth ? count : 0;
        flat->colors_count += colored ? count : 0;
    }
    return true;
}

BvhLeaves flat_leaves(NodeLayout layout)
{
    return layout == NODES_WIDE ? LEAVES_BLOCKS : LEAVES_SINGLE;
}

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
    vec3_store(data->position, normalize_light(normalization, light));
    data->intensity = (float)light->intensity;
    vec3_store(data->color, light->color);
}

static bool allocate(FlatScene *flat, const Scene *scene, Error *error)
{
    flat->light_count = (uint32_t)scene->lights.count;
    flat->material_count = (uint32_t)scene->materials.count;
    flat->sphere_count = flat->sphere_entries = (uint32_t)scene->spheres.count;
    flat->triangle_count = (uint32_t)scene_triangle_count(scene);
    flat->lights = memory_zeroed(flat->light_count, sizeof *flat->lights, error);
    flat->materials = memory_zeroed(flat->material_count, sizeof *flat->materials, error);
    flat->spheres = memory_zeroed(flat->sphere_count, sizeof *flat->spheres, error);
    return flat->lights != NULL && flat->materials != NULL && flat->spheres != NULL;
}

static void flatten_constants(FlatScene *flat, const Scene *scene,
                              const Normalization *normalization)
{
    vec3_store(flat->background, scene->background);
    flat->ambient = (float)scene->ambient;
    for (uint32_t i = 0; i < flat->material_count; i++) {
        flat->materials[i] = scene->materials.data[i];
        normalize_checker(&flat->materials[i], normalization);
    }
}

static bool make_all(FlatScene *flat, const FlatSource *source, Error *error)
{
    const Scene *scene = source->scene;
    const Normalization *normalization = source->normalization;
    if (!allocate(flat, scene, error))
        return false;
    flatten_constants(flat, scene, normalization);
    for (uint32_t i = 0; i < flat->light_count; i++)
        flatten_light(&flat->lights[i], &scene->lights.data[i], normalization);
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        flatten_sphere(&flat->spheres[i], &scene->spheres.data[i], normalization);
    flat->bounds = flat_nodes_bounds(flat, source);
    flat->sphere_root = NOTHING;
    if (source->layout == NODES_PAIR && flat_has_sphere_tree(flat, source) &&
        !sphere_tree_make(flat, error))
        return false;
    return flat_looks_make(flat, source, error) &&
           (source->layout == NODES_WIDE ? flat_nodes_make_wide(flat, source, error)
                                         : flat_nodes_make_pairs(flat, source, error));
}

bool flat_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    *flat = (FlatScene){.layout = source->layout};
    if (make_all(flat, source, error))
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
    free(flat->colors);
    *flat = (FlatScene){0};
}

void flat_arrays(const FlatScene *flat, FlatArray arrays[FLAT_ARRAYS])
{
    const bool is_wide = flat->layout == NODES_WIDE;
    const FlatArray nodes =
        is_wide ? (FlatArray){"nodes", flat->wides, flat->node_count * sizeof *flat->wides}
                : (FlatArray){"nodes", flat->pairs, flat->node_count * sizeof *flat->pairs};
    const FlatArray triangles =
        is_wide ? (FlatArray){"triangles", flat->blocks, flat->block_count * sizeof *flat->blocks}
                : (FlatArray){"triangles", flat->triangles,
                              flat->triangle_count * sizeof *flat->triangles};
    const size_t looks = is_wide ? flat->triangle_count : 0;
    const FlatArray all[FLAT_ARRAYS] = {
        {"lights", flat->lights, flat->light_count * sizeof *flat->lights},
        {"materials", flat->materials, flat->material_count * sizeof *flat->materials},
        {"spheres", flat->spheres, flat->sphere_entries * sizeof *flat->spheres},
        nodes,
        triangles,
        {"looks", flat->looks, looks * sizeof *flat->looks},
        {"normals", flat->normals, flat->normals_count * sizeof *flat->normals},
        {"colors", flat->colors, flat->colors_count * sizeof *flat->colors}};
    memcpy(arrays, all, sizeof all);
}
