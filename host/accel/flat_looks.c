// SPDX-License-Identifier: MIT
// Processes one mesh object at a time. Threads process chunks of its triangles.
#include "accel/flat_parts.h"

#include <string.h>

typedef struct {
    const MeshObject *object;
    const uint8_t *orders;  // the object's section of Triangles::orders
    TriangleLook *looks;    // its section of FlatScene::looks
    CornerNormals *normals; // its section of FlatScene::normals; NULL for flat shading
    uint32_t first_normals; // index where that section begins
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
    return vec3_extent(normal) > 0 ? normal : face_normal(mesh, triangle);
}

// Returns -1 if sorting the corners swapped front and back, otherwise 1.
static int sign_of(const CornerOrder *order)
{
    return order->reversed ? -1 : 1;
}

// Stores a triangle's normals, scaled by one power of two that keeps their squares in range. The
// ratios of their lengths stay unchanged, because they are interpolation weights.
static void scale_normals(CornerNormals *data, const Mesh *mesh, const uint32_t *triangle,
                          const CornerOrder *order)
{
    Vec3 normals[3];
    double extent = 0;
    for (int corner = 0; corner < 3; corner++) {
        normals[corner] = corner_normal(mesh, triangle, order->places[corner]);
        extent = fmax(extent, vec3_extent(normals[corner]));
    }
    const double scale = sign_of(order) * (extent > 0 ? scalbn(1, -ilogb(extent)) : 1);
    for (int corner = 0; corner < 3; corner++) {
        vec3_store(data->normals[corner], vec3_scale(normals[corner], scale));
        data->normals[corner][3] = 0;
    }
}

static float extent_of(const float *normal)
{
    const float x = fabsf(normal[0]), y = fabsf(normal[1]), z = fabsf(normal[2]);
    const float xy = x > y ? x : y;
    return xy > z ? xy : z;
}

// Returns 2^-floor(log2(value)) for a positive value. The result must be a normal number.
static float inverse_power(float value)
{
    uint32_t bits;
    float power;
    memcpy(&bits, &value, sizeof bits);
    bits = (254 - (bits >> 23)) << 23;
    memcpy(&power, &bits, sizeof power);
    return power;
}

// Computes the same bits as scale_normals, but in float. Returns false, without a result, if a
// normal is missing or its size is extreme.
static bool scale_usual_normals(CornerNormals *data, const Mesh *mesh, const uint32_t *triangle,
                                const CornerOrder *order)
{
    const float *normals[3];
    float smallest = INFINITY, largest = 0;
    for (int corner = 0; corner < 3; corner++) {
        normals[corner] = mesh->normals[triangle[order->places[corner]]];
        const float extent = extent_of(normals[corner]);
        smallest = extent < smallest ? extent : smallest;
        largest = extent > largest ? extent : largest;
    }
    if (!(smallest > 0x1p-100f && largest < 0x1p100f))
        return false;
    const float scale = (float)sign_of(order) * inverse_power(largest);
    for (int corner = 0; corner < 3; corner++) {
        for (int axis = 0; axis < 3; axis++)
            data->normals[corner][axis] = normals[corner][axis] * scale;
        data->normals[corner][3] = 0;
    }
    return true;
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
        if (smooth && !scale_usual_normals(&looks->normals[i], mesh, triangle, order))
            scale_normals(&looks->normals[i], mesh, triangle, order);
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
