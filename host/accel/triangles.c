// SPDX-License-Identifier: MIT
// Normalizes every vertex in fp64 and rounds it once to float. Triangles that share a vertex in the
// file share the rounded point, so neighbors stay neighbors.
//
// The corners of each triangle are sorted by their coordinates. The device then computes the same
// bits regardless of the order of the corners in the file. For an edge that two triangles share,
// the device computes equal values in both. Three comparisons, mostly of x alone, form an index
// into a table of corner orders. A branch on each comparison would be mispredicted half the time.
#include "accel/triangles.h"

#include <stdlib.h>

// Bit 0 of the index: the second corner precedes the first. Bit 1: the third precedes the second.
// Bit 2: the third precedes the first. Indices 3 and 4 cannot occur.
const CornerOrder corner_orders[8] = {
    [0] = {{0, 1, 2}, false}, [1] = {{1, 0, 2}, true},  [2] = {{0, 2, 1}, true},
    [5] = {{1, 2, 0}, false}, [6] = {{2, 0, 1}, false}, [7] = {{2, 1, 0}, true}};

static int precedes(const float *a, const float *b)
{
    if (a[0] != b[0])
        return a[0] < b[0];
    return a[1] != b[1] ? a[1] < b[1] : a[2] < b[2];
}

uint8_t corner_order(const float *a, const float *b, const float *c)
{
    const int has_equal = (a[0] == b[0]) | (b[0] == c[0]) | (c[0] == a[0]);
    if (has_equal)
        return (uint8_t)(precedes(b, a) | precedes(c, b) << 1 | precedes(c, a) << 2);
    return (uint8_t)((b[0] < a[0]) | (c[0] < b[0]) << 1 | (c[0] < a[0]) << 2);
}

// A mesh and its sections of the arrays in Triangles.
typedef struct {
    const Mesh *mesh;
    const Normalization *normalization;
    float (*points)[4];
    uint32_t (*corners)[3];
    uint8_t *orders;
    uint32_t first_point; // index of the mesh's first point
} Storing;

// Turns -0 into +0, because equal points must have equal bits.
static float without_negative_zero(float value)
{
    return value + 0.0f;
}

static void store_points(void *context, uint32_t first, uint32_t end)
{
    const Storing *storing = context;
    for (uint32_t vertex = first; vertex < end; vertex++) {
        const Vec3 p = normalize_point(storing->normalization,
                                       vec3_of_doubles(storing->mesh->positions[vertex]));
        float *point = storing->points[vertex];
        point[0] = without_negative_zero((float)p.x);
        point[1] = without_negative_zero((float)p.y);
        point[2] = without_negative_zero((float)p.z);
        point[3] = 0;
    }
}

static void store_corners(void *context, uint32_t first, uint32_t end)
{
    const Storing *storing = context;
    for (uint32_t triangle = first; triangle < end; triangle++) {
        const uint32_t *vertices = storing->mesh->triangles[triangle];
        for (int corner = 0; corner < 3; corner++)
            storing->corners[triangle][corner] = storing->first_point + vertices[corner];
        storing->orders[triangle] =
            corner_order(storing->points[vertices[0]], storing->points[vertices[1]],
                         storing->points[vertices[2]]);
    }
}

static void store_mesh(Triangles *triangles, const Mesh *mesh, const Normalization *normalization,
                       ThreadPool *pool)
{
    Storing storing = {mesh,
                       normalization,
                       triangles->points + triangles->point_count,
                       triangles->corners + triangles->count,
                       triangles->orders + triangles->count,
                       (uint32_t)triangles->point_count};
    thread_pool_share(pool, (uint32_t)mesh->vertex_count, CHUNK_ELEMENTS, store_points, &storing);
    thread_pool_share(pool, (uint32_t)mesh->triangle_count, CHUNK_ELEMENTS, store_corners,
                      &storing);
    triangles->point_count += mesh->vertex_count;
    triangles->count += mesh->triangle_count;
}

static size_t vertex_count(const Scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->objects.count; i++)
        count += scene->objects.data[i].mesh.vertex_count;
    return count;
}

bool triangles_make(Triangles *triangles, const Scene *scene, const Normalization *normalization,
                    ThreadPool *pool, Error *error)
{
    const size_t count = scene_triangle_count(scene), points = vertex_count(scene);
    *triangles = (Triangles){0};
    // Triangles and spheres share one range of 30-bit ids (kernels/shared.h).
    if (count + scene->spheres.count >= 0x3fffffff)
        return error_set(error, "the scene has %zu triangles and %zu spheres, more than 2^30 - 2",
                         count, scene->spheres.count);
    if (points > UINT32_MAX)
        return error_set(error, "the scene has %zu vertices, more than 2^32 - 1", points);
    triangles->points = memory_raw(points, sizeof *triangles->points, error);
    triangles->corners = memory_raw(count, sizeof *triangles->corners, error);
    triangles->orders = memory_raw(count, sizeof *triangles->orders, error);
    if (triangles->points == NULL || triangles->corners == NULL || triangles->orders == NULL) {
        triangles_free(triangles);
        return false;
    }
    for (size_t i = 0; i < scene->objects.count; i++)
        store_mesh(triangles, &scene->objects.data[i].mesh, normalization, pool);
    return true;
}

void triangles_free(Triangles *triangles)
{
    free(triangles->points);
    free(triangles->corners);
    free(triangles->orders);
    *triangles = (Triangles){0};
}
