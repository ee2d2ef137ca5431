// SPDX-License-Identifier: MIT
// Processes one mesh object at a time. Threads process chunks of its triangles.
#include "accel/flat_parts.h"

#include <string.h>

typedef struct {
    const MeshObject *object;
    const uint8_t *orders;  // the object's section of Triangles::orders
    TriangleLook *looks;    // the object's section of FlatScene::looks
    CornerNormals *normals; // its section of FlatScene::normals; NULL for flat shading
    uint32_t first_normals; // index in FlatScene::normals of the section's first element
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

// fmax would be a function call.
static double larger(double a, double b)
{
    return a > b ? a : b;
}

// Returns 2^-floor(log2(value)) for values in [2^-1022, 2^1023), faster than ilogb and scalbn.
static double inverse_power(double value)
{
    uint64_t bits;
    double power;
    memcpy(&bits, &value, sizeof bits);
    bits = (2046 - (bits >> 52)) << 52;
    memcpy(&power, &bits, sizeof power);
    return power;
}

// Stores a triangle's normals, negated if the stored corners are reversed. A common power of two
// brings their squares into range, without changing their relative weights in the interpolation.
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

static void make_chunk(void *context, uint32_t first, uint32_t end)
{
    const ObjectLooks *looks = context;
    const MeshObject *object = looks->object;
    const Mesh *mesh = &object->mesh;
    const uint32_t material = object->material | (object->two_sided ? TRIANGLE_TWO_SIDED : 0);
    const bool smooth = looks->normals != NULL;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t *triangle = mesh->triangles[i];
        const CornerOrder *order = &corner_orders[looks->orders[i]];
        looks->looks[i].material = material | (order->reversed ? TRIANGLE_REVERSED : 0);
        looks->looks[i].normals = smooth ? looks->first_normals + i : NOTHING;
        if (smooth)
            store_normals(&looks->normals[i], mesh, triangle, order);
    }
}

static uint32_t count_smooth_triangles(const Scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->objects.count; i++)
        if (scene->objects.data[i].mesh.normals != NULL)
            count += scene->objects.data[i].mesh.triangle_count;
    return (uint32_t)count;
}

bool flat_looks_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    const Scene *scene = source->scene;
    size_t first = 0;
    flat->looks = memory_raw(flat->triangle_count, sizeof *flat->looks, error);
    flat->normals = memory_raw(count_smooth_triangles(scene), sizeof *flat->normals, error);
    if (flat->looks == NULL || flat->normals == NULL)
        return false;
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        const uint32_t count = (uint32_t)object->mesh.triangle_count;
        const bool smooth = object->mesh.normals != NULL;
        ObjectLooks looks = {object, source->triangles->orders + first, flat->looks + first,
                             smooth ? flat->normals + flat->normals_count : NULL,
                             flat->normals_count};
        thread_pool_share(source->pool, count, CHUNK_ELEMENTS, make_chunk, &looks);
        first += count;
        flat->normals_count += smooth ? count : 0;
    }
    return true;
}
